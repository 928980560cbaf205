"""Limits of fine meshes, and the value that errors are measured against."""


def aitken(values):
    """Limit of three values on meshes each twice as fine: as of v + c h^p with p from 0.5 to 4. Where they do not fall in with
    that, the last one."""
    first, second, third = values
    before, after = second - first, third - second
    if after == 0.0 or not 2.0**0.5 <= before / after <= 16.0:
        return third
    return third - after * after / (after - before)


def limits(by_run):
    """By (code, variant) the limit of its meshes, at the case's steps and tolerance; and the reference, the mean of the two codes'
    limits (without variants), with half their difference."""
    found = {}
    for key in {(run.code, run.variant) for run in by_run}:
        meshes = sorted((run.mesh, value) for run, value in by_run.items()
                        if (run.code, run.variant) == key and run.steps == run.tolerance == 1.0)
        values = [value for _, value in meshes]
        if values:
            found[key] = aitken(values[-3:]) if len(values) >= 3 else values[-1]
    plain = [limit for (_, variant), limit in found.items() if not variant]
    if not plain:
        return found, float("nan"), float("nan")
    return found, (max(plain) + min(plain)) / 2, (max(plain) - min(plain)) / 2
