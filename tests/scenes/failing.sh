# Allocations, writes, names and threads that fail, a few of each for every command: `make faults` tries them all.
FAULTS=2 bash tests/faults/run.sh
