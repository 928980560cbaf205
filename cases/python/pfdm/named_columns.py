"""Tables that help with the names of their columns."""

from __future__ import annotations

from typing import Any

import pandas

from .errors import no_such


class NamedColumns(pandas.DataFrame):
    """A table whose KeyError has the columns that are spelled like one that is not there.

    What pandas makes of it, as of some of its rows, is a plain DataFrame.
    """

    @property
    def _constructor(self) -> type[pandas.DataFrame]:
        return pandas.DataFrame

    def __getitem__(self, key: Any) -> Any:
        try:
            return super().__getitem__(key)
        except KeyError:
            if not isinstance(key, str):
                raise
            raise no_such(key, self.columns) from None
