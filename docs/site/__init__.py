"""The documentation site: pages, generated references and live pages, as files that need no network.

    python -m docs.site            writes build/site/index.html

- `pages`: the Markdown files and where each stands in the site; links that lead out of them
- `commands`, `api`: the references that are written from the commands and the docstrings
- `live`: the models as pages that compute, and the directive that shows them
- `mathml`: equations without a script
- `conf.py`: what Sphinx is told
"""
