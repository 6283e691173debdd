"""Runs a command and keeps what it took: timed.py RECORD COMMAND... RECORD: seconds (wall), seconds of CPU time, threads as told ("all"
where the command line has no --threads). The command's status and messages are its own; signals that end it are passed on to it."""
import os
import signal
import sys
import time

record, command = sys.argv[1], sys.argv[2:]
began = time.monotonic()
child = os.fork()
if child == 0:
    try:
        os.execvp(command[0], command)
    except OSError as error:
        os.write(2, f"{command[0]}: {error.strerror}\n".encode())
    os._exit(127)
for ending in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
    signal.signal(ending, lambda number, _: os.kill(child, number))
_, status, used = os.wait4(child, 0)
code = os.waitstatus_to_exitcode(status)
if code == 0:
    threads = command[command.index("--threads") + 1] if "--threads" in command else "all"
    with open(record + ".part", "w") as file:
        file.write(f"{time.monotonic() - began:.2f} {used.ru_utime + used.ru_stime:.2f} {threads}\n")
    os.replace(record + ".part", record)
sys.exit(code if code >= 0 else 128 - code)
