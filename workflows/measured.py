"""Runs a command and keeps what it cost: measured.py [--limit SECONDS] RECORD.json COMMAND...

RECORD.json: status (of the command; 128 + n where signal n ended it), seconds (wall), cpu_seconds, peak_memory (bytes, largest resident set),
limit (null, or the seconds after which it was ended), message (last line that it wrote to stderr). A command that fails or is ended is a
result like the others; one that was called wrongly (status 2, 3, 4) is an error. The limit is one of CPU time, which hangs little on what else
runs; four times as much by the clock ends it as well. A run that was stopped with this script goes on from its checkpoint when it is called again, and what it had taken
until then, kept in RECORD.json.spent, counts. It imports no more than it must: a process begins with the resident set of the one that
started it.
"""
import json
import os
import signal
import sys
import time

arguments, limit = sys.argv[1:], None
if arguments[0] == "--limit":
    limit, arguments = float(arguments[1]), arguments[2:]
record, command = arguments[0], arguments[1:]
log, spent = record + ".log", record + ".spent"
earlier_seconds, earlier_cpu = 0.0, 0.0
if os.path.exists(spent) and os.path.getmtime(spent) > os.path.getmtime(command[0]):     # by this build
    with open(spent) as file:
        kept = json.load(file)
    if kept["command"] == command:
        earlier_seconds, earlier_cpu = kept["seconds"], kept["cpu_seconds"]

began = time.monotonic()
child = os.fork()
if child == 0:
    try:
        output = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
        os.dup2(output, 2)
        os.execvp(command[0], command)
    except OSError as error:
        os.write(2, f"{command[0]}: {error.strerror}\n".encode())
    os._exit(127)
late, stopped = False, 0


def stop(number, _):
    """This process is told to end: so is the command, and nothing is recorded but what it has taken."""
    global stopped
    stopped = number
    os.kill(child, number)


for ending in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
    signal.signal(ending, stop)


def out_of_time(*_):
    global late
    with open(f"/proc/{child}/stat") as file:
        user, system = file.read().rsplit(")", 1)[1].split()[11:13]
    if earlier_cpu + (int(user) + int(system)) / os.sysconf("SC_CLK_TCK") > limit or earlier_seconds + time.monotonic() - began > 4 * limit:
        late = True
        os.kill(child, signal.SIGTERM)


if limit is not None:
    signal.signal(signal.SIGALRM, out_of_time)
    signal.setitimer(signal.ITIMER_REAL, 0.2, 0.2)
_, status, used = os.wait4(child, 0)
signal.setitimer(signal.ITIMER_REAL, 0)
seconds = earlier_seconds + time.monotonic() - began
cpu_seconds = earlier_cpu + used.ru_utime + used.ru_stime
status = os.waitstatus_to_exitcode(status)
if stopped:
    with open(spent + ".part", "w") as file:
        json.dump({"command": command, "seconds": seconds, "cpu_seconds": cpu_seconds}, file)
    os.replace(spent + ".part", spent)
    sys.exit(128 + stopped)
if os.path.exists(spent):
    os.remove(spent)
with open(log, errors="replace") as lines:
    said = [line.strip() for line in lines if line.strip()]
if status in (2, 3, 4, 127):  # the study's own mistake, or a full disk
    sys.exit("\n".join(said) or f"{command[0]}: status {status}")
result = {"status": status if status >= 0 else 128 - status, "seconds": seconds, "cpu_seconds": cpu_seconds,
          "peak_memory": used.ru_maxrss * 1024, "limit": limit if late else None, "message": said[-1] if said else ""}
with open(record + ".part", "w") as file:
    json.dump(result, file, indent=1)
os.replace(record + ".part", record)
