# Fault injection: a few failing allocations, writes, renames and threads for every command; `make faults` tries all.
FAULTS=2 bash tests/faults/run.sh
