"""What the program may do with a bad input: end soon, with little memory, with one message that says where."""

import contextlib
import os
import re
import resource
import signal
import subprocess
import tempfile
import threading
from pathlib import Path

SECONDS, BYTES, LONGEST = 60, 2 * 1000**3, 300
INSIDE = re.compile(r"exception|internal error|HDF5-DIAG|std::|terminate|[Aa]ssert|basic_string|vector::")


def limit():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (2 * SECONDS, 2 * SECONDS))


def run(command):
    """(exit status, negative for signals; messages; seconds over the limit; largest memory in bytes)"""
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors, preexec_fn=limit,
                                   start_new_session=True)
        late = threading.Event()

        def stop():
            late.set()
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)  # with what it has begun

        timer = threading.Timer(SECONDS, stop)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        return process.returncode, errors.read(1_000_000), late.is_set(), usage.ru_maxrss * 1024


def content_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}


def faults(outcome, folder, places, surely_wrong):
    """What is not as it should be; `places`: words of which a message has to hold one."""
    status, errors, late, memory = outcome
    text = errors.decode("utf-8", "replace")
    found = []
    if late:
        return [f"no end within {SECONDS} s"]
    if status not in (0, 1, 2):
        found.append(f"exit status {status}")
    if memory > BYTES:
        found.append(f"{memory / 1e9:.1f} GB")
    if status == 0:
        if surely_wrong:
            found.append("accepted")
        return found + (["a message in spite of exit status 0"] if text else [])
    if text.count("\n") != 1 or not text.endswith("\n"):
        found.append(f"{text.count(chr(10))} lines")
    if len(text.replace(str(folder), "").encode()) > LONGEST:
        found.append(f"{len(text)} characters")
    if "\ufffd" in text or re.search(r"[\x00-\x09\x0b-\x1f\x7f]", text):
        found.append("control characters")
    if word := INSIDE.search(text):
        found.append(f"words of the inside: {word[0]}")
    if not any(place in text for place in places):
        found.append("neither file nor key")
    return found
