"""Many runs of a case side by side."""

from __future__ import annotations

import itertools
import os
import threading
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .case import Case
from .errors import ComputationError, InputError
from .program import interrupt
from .results import Results

if TYPE_CHECKING:
    import pandas


def _run(case: Case, output: Path, threads: int, workers: set[int]) -> Results | str:
    """The results, made or found; or why the computation failed. Adds the thread to `workers`."""
    workers.add(threading.get_ident())
    try:
        try:
            return case.run(output, threads=threads, restart=True)
        except InputError as error:
            if "without --restart" not in str(error):
                raise
        return case.run(output, threads=threads)
    except ComputationError as error:
        return str(error)


def sweep(case: Case, values: Mapping[str, Sequence[Any]], folder: str | Path, *, processes: int | None = None,
          threads: int = 1) -> pandas.DataFrame:
    """Runs a case with all combinations of values, several side by side, and tells what came out.

    Each run has a directory of its own, folder/0000, folder/0001, ...; the same call goes on where an earlier one was
    interrupted, and computes nothing twice.

    Args:
        case: the case; its own values hold where `values` has none.
        values: key to its values, as {"regions.interface.toughness": ["100 J/m^2", "200 J/m^2"]}.
        folder: directory of the study.
        processes: how many runs go side by side; None: one for each core, by `threads`.
        threads: of each run.

    Returns:
        A row for each run: a column for each key, then the figures of summary.json, "status" (of a run that failed
        the reason) and "results", the Results of each.

    Raises:
        InputError: the case is wrong with one of the sets of values; the other runs end in order.
    """
    import pandas

    keys = list(values)
    sets = [dict(zip(keys, each, strict=True)) for each in itertools.product(*values.values())]
    places = [Path(folder) / f"{i:04d}" for i in range(len(sets))]
    at_once = processes or max(1, len(os.sched_getaffinity(0)) // threads)
    workers: set[int] = set()
    with ThreadPoolExecutor(at_once) as pool:
        jobs = [pool.submit(_run, case.with_values(each), place, threads, workers)
                for each, place in zip(sets, places, strict=True)]
        try:
            ended = [job.result() for job in jobs]
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            interrupt(workers)
            raise
    rows = []
    for each, place, end in zip(sets, places, ended, strict=True):
        figures = {} if isinstance(end, str) else {k: v for k, v in end.summary.items() if not isinstance(v, dict)}
        status = f"failed: {end}" if isinstance(end, str) else end.status
        rows.append({**{key: str(value) for key, value in each.items()}, **figures, "status": status,
                     "results": Results(place)})
    return pandas.DataFrame(rows)
