#!/bin/bash
# scripts/cluster on a real Slurm and by Snakemake: the runs of a sweep are killed in the middle, resumed and merged, and
# the merged file is that of one machine, byte for byte. munged, slurmctld and slurmd run in a temporary folder, with ports
# and a configuration of their own, as any user, and are ended in any case.
cd "$(dirname "$0")/../.." || exit 1
. tests/scenes/lib.sh
program=$(realpath "$JOSTLE") cluster=$PWD/scripts/cluster
export JOSTLE=$program
mkdir -p "$work/project/scenes" "$work/project/behaviours" "$work/project/scripts"
cp scenes/evacuation.yaml "$work/project/scenes/rooms.yaml"
cp behaviours/*.lua "$work/project/behaviours/"
cp scripts/*.lua "$work/project/scripts/"
cd "$work/project" || exit 1
study=(scenes/rooms.yaml --set groups.hall.count=60,200 --seeds 6 --for 60)
runs=12

"$program" sweep "${study[@]}" --out one.sqlite --canonical --quiet && [ "$(sqlite3 one.sqlite 'select count(*) from run')" = $runs ]; verdict "a study on one machine" $?
# count_parts FOLDER: prints how many runs have their file.
count_parts() { find "$1" -name 'run-*.sqlite' 2>/dev/null | wc -l; }
# stamp FOLDER: prints the identity of each file: another one after a run was done again.
stamp() { stat -c '%n %i %Y %s' "$1"/run-*.sqlite; }
# kept_all BEFORE FOLDER: whether no run that has a file in the list BEFORE was done again.
kept_all() { [ -s "$1" ] && [ -z "$(stamp "$2" | grep -vxFf - "$1")" ]; }
# wait_for SECONDS COMMAND...: waits until a command succeeds; fails after so many seconds.
wait_for() {
    local end=$((SECONDS + $1)); shift
    until "$@"; do [ $SECONDS -lt $end ] || return 1; sleep 0.1; done
}
has_parts() { [ "$(count_parts "$1")" -ge "$2" ]; } # FOLDER COUNT
# whole FOLDER: whether every file there has a run that ended.
whole() {
    local f
    for f in "$1"/run-*.sqlite; do [ "$(sqlite3 -readonly "$f" "select state from run")" = done ] || return 1; done
}
missing_by_name() { # FOLDER NAME: a removed result makes the merge fail, by its name
    mv "$1/run-000008.sqlite" away
    expect "$2" 3 "run 8: count=200, seed 2" "$program" sweep --merge "$1" --out no.sqlite --canonical
    [ ! -e no.sqlite ]; verdict "  and nothing is merged" $?
    mv away "$1/run-000008.sqlite"
}

# ---- Slurm ----
daemons=()
end_slurm() {
    scancel --quiet -u "$(id -un)" 2>/dev/null
    wait_for 15 queue_is_empty 2>/dev/null
    local pid
    for pid in "${daemons[@]}"; do kill "$pid" 2>/dev/null; done
    for pid in "${daemons[@]}"; do
        wait_for 10 is_over "$pid" || kill -KILL "$pid"
        wait "$pid" 2>/dev/null
    done
    daemons=()
}
is_over() { ! kill -0 "$1" 2>/dev/null; }
queue_is_empty() { local jobs; jobs=$(squeue -h 2>/dev/null) && [ -z "$jobs" ]; }
free_ports() { # COUNT: prints ports that nobody listens at
    python3 -c 'import socket, sys
taken = [socket.socket() for _ in range(int(sys.argv[1]))]
for s in taken: s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in taken))' "$1"
}
node_is_idle() { [ "$(sinfo -h -o %T 2>/dev/null)" = idle ]; }
begin_slurm() {
    local d=$work/slurm me controller node
    me=$(id -un)
    mkdir -p "$d/state" "$d/spool" "$d/munge"
    chmod 755 "$work" "$d" "$d/munge" # munged wants its socket to be within reach of all
    head -c 1024 /dev/urandom >"$d/key" && chmod 600 "$d/key"
    munged --foreground --force --socket="$d/munge/socket" --key-file="$d/key" --pid-file="$d/munge/pid" \
        --log-file="$d/munge.log" --seed-file="$d/seed" >/dev/null 2>&1 &
    daemons+=($!)
    read -r controller node < <(free_ports 2)
    cat >"$d/slurm.conf" <<END
ClusterName=jostle
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$controller
SlurmdPort=$node
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$d/munge/socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
StateSaveLocation=$d/state
SlurmdSpoolDir=$d/spool
SlurmctldPidFile=$d/slurmctld.pid
SlurmdPidFile=$d/slurmd.pid
SchedulerParameters=batch_sched_delay=0,sched_interval=1
KillWait=5
CompleteWait=0
NodeName=here NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=here Default=YES MaxTime=INFINITE State=UP
END
    export SLURM_CONF=$d/slurm.conf
    wait_for 10 test -S "$d/munge/socket" || return 1
    slurmctld -D -c -f "$SLURM_CONF" >"$d/slurmctld.log" 2>&1 &
    daemons+=($!)
    slurmd -D -N here -f "$SLURM_CONF" >"$d/slurmd.log" 2>&1 &
    daemons+=($!)
    wait_for 30 node_is_idle
}
trap 'end_slurm; rm -rf "$work"' EXIT
trap 'exit 143' TERM INT HUP

test_slurm() {
    begin_slurm
    local began=$?
    verdict "Slurm begins on this machine" $began
    [ $began = 0 ] || { tail -3 "$work"/slurm/*.log; return; }
    export TASKS=4
    expect "submit submits a study" 0 "12 runs in 4 tasks" "$cluster/submit" --job-name=study -- "${study[@]}" --out many.sqlite
    wait_for 120 has_parts many-parts 2; verdict "  tasks of the array do runs" $?
    # One run is killed as by a system that is out of memory, then all tasks are cancelled.
    kill -KILL "$(pgrep -f -- '--out many-parts/run-' | while read -r p; do [ "$(readlink "/proc/$p/exe")" = "$program" ] && echo "$p"; done | tail -1)"
    sleep 0.3
    scancel -n study
    wait_for 60 queue_is_empty
    [ "$(count_parts many-parts)" -ge 2 ] && [ "$(count_parts many-parts)" -lt $runs ] && whole many-parts; verdict "  cancelled after $(count_parts many-parts) runs: each file is whole" $?
    [ -z "$(find many-parts -name '*.part' -o -name '*-journal')" ] && [ -z "$(pgrep -f -- '--out many-parts/run-')" ]; verdict "  no half file and no process is left" $?
    grep -q '^  run 12: count=200, seed 6$' many-parts/slurm-merge-*.txt && [ ! -e many.sqlite ]; verdict "  the job that merges names what is missing" $?
    stamp many-parts >before
    left=$((runs - $(count_parts many-parts)))
    expect "  submitted again, it has the missing runs alone" 0 ": $left runs in" "$cluster/submit" "${study[@]}" --out many.sqlite
    wait_for 240 queue_is_empty
    kept_all before many-parts; verdict "  what was done is not done again" $?
    cmp one.sqlite many.sqlite; verdict "  the merged file is that of one machine, byte for byte" $?
    rm many.sqlite
    expect "  once more, it merges alone" 0 "all runs are done" "$cluster/submit" "${study[@]}" --out many.sqlite
    cmp one.sqlite many.sqlite; verdict "  to the same file" $?
    missing_by_name many-parts "a result that was removed is named"

    short=(scenes/rooms.yaml --set groups.hall.count=20,30 --seeds 2 --for 2)
    cp scenes/rooms.yaml "scenes/d'été -- 2.yaml"
    LC_ALL=C "$cluster/submit" "scenes/d'été -- 2.yaml" "${short[@]:1}" --out "l'été.sqlite" >odd.txt 2>&1
    wait_for 60 queue_is_empty
    [ "$(sqlite3 "l'été.sqlite" 'select count(*) from run')" = 4 ]; verdict "names with quotes, blanks and accents reach the job that merges" $?
    "$program" sweep "${short[@]}" --out step.sqlite --list >jobs
    srun --quiet -n 2 --overcommit bash "$cluster/jostle.sbatch" jobs >srun.txt 2>&1
    [ "$(count_parts step-parts)" = 4 ] && [ "$(grep -c ': 2 runs are done' srun.txt)" = 2 ]; verdict "srun: two processes do a share each" $?
    if command -v snakemake >/dev/null; then
        timeout 120 snakemake -s "$cluster/Snakefile" --jobs 4 --cluster "sbatch --parsable -o /dev/null" --config sweep="${short[*]}" out=snake-slurm.sqlite jostle="$program" >snake.txt 2>&1
        "$program" sweep --merge step-parts --out step.sqlite --canonical --quiet && cmp step.sqlite snake-slurm.sqlite; verdict "Snakemake submits runs to Slurm" $?
    fi
    end_slurm
    queue_is_empty; [ $? != 0 ] && [ -z "$(pgrep -f "$work/slurm")" ]; verdict "Slurm is ended" $?
}

# ---- MPI launchers ----
test_mpi() {
    local as_root=
    [ "$(id -u)" = 0 ] && as_root=--allow-run-as-root
    "$program" sweep scenes/rooms.yaml --set groups.hall.count=20,30 --seeds 2 --for 2 --out mpi.sqlite --list >jobs
    mpirun.openmpi $as_root --oversubscribe -n 3 bash "$cluster/jostle.sbatch" jobs >mpi.txt 2>&1
    [ "$(count_parts mpi-parts)" = 4 ] && [ "$(grep -c '^share . of 3' mpi.txt)" = 3 ]; verdict "mpirun of Open MPI: three processes do a share each" $?
}

# ---- Snakemake ----
snake() { snakemake -s "$cluster/Snakefile" --cores 2 --nocolor "$@" --config sweep="${study[*]}" out=snake.sqlite jostle="$program"; }
test_snakemake() {
    local pid left
    snakemake -s "$cluster/Snakefile" --cores 2 --nocolor --config sweep="${study[*]}" out=snake.sqlite jostle="$program" >snake.txt 2>&1 &
    pid=$!
    wait_for 120 has_parts snake-parts 3; verdict "Snakemake does runs" $?
    kill -TERM $pid; wait $pid
    left=$?
    [ $left != 0 ] && has_parts snake-parts 2 && ! has_parts snake-parts $runs && [ ! -e snake.sqlite ] && whole snake-parts; verdict "  ended in the middle, after $(count_parts snake-parts) runs: each file is whole" $?
    stamp snake-parts >before
    snake --rerun-incomplete >snake.txt 2>&1 && kept_all before snake-parts; verdict "  with --rerun-incomplete it goes on, and repeats no run" $?
    cmp one.sqlite snake.sqlite; verdict "  the merged file is that of one machine, byte for byte" $?
    missing_by_name snake-parts "  a result that was removed is named"
    rm snake-parts/run-000008.sqlite snake.sqlite
    stamp snake-parts >before
    snake >snake.txt 2>&1 && cmp one.sqlite snake.sqlite && kept_all before snake-parts; verdict "  and it alone is done again" $?
}

for tool in "Slurm slurmctld test_slurm" "MPI mpirun.openmpi test_mpi" "Snakemake snakemake test_snakemake"; do
    set -- $tool
    if command -v "$2" >/dev/null; then $3; else echo "ok $1 is not tested: $2 is not installed (.ci/setup cluster installs it)"; fi
done
