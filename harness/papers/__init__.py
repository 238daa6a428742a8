"""What the papers and slides say, worked out: bending linkages, the study, and every row of the documents."""
