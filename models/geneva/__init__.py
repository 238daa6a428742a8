"""The external Geneva drive: a pin turns a slotted wheel by one station per turn, and an arc locks it between."""
