"""kill_at.py CPU COMMAND...: runs a command, and kills it (SIGKILL) once its own process has taken so many seconds of
processor time: a moment of its progress, whatever else the machine does. Prints the seconds that it had taken."""
import os
import signal
import subprocess
import sys
import time

PROCESS_CLOCK = 2  # as clock_getcpuclockid makes the number of a clock


def main():
    limit = float(sys.argv[1])
    run = subprocess.Popen(sys.argv[2:])
    spent = 0.0
    while run.poll() is None:
        try:
            spent = time.clock_gettime((~run.pid << 3) | PROCESS_CLOCK)
        except OSError:
            break
        if spent >= limit:
            os.kill(run.pid, signal.SIGKILL)
            break
        time.sleep(min(0.002, max(0.0002, limit - spent)))
    run.wait()
    print(f"{spent:.3f}")


main()
