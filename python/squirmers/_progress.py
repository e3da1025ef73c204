"""Progress of long work, shown by tqdm where it is installed."""

from __future__ import annotations

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    Running = list[tuple[int, str, int, int | None]]
    Show = Callable[[Running], None]


def _in_notebook() -> bool:
    return "ipykernel" in sys.modules


def shower(progress: bool | None) -> Show | None:
    """What shows the work that is running: nothing, or bars of tqdm.

    Parameters
    ----------
    progress : bool or None
        Whether to show it. None shows it in a terminal or a notebook.
    """
    if progress is False:
        return None
    if progress is None and not (sys.stderr.isatty() or _in_notebook()):
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    bars: dict[int, Any] = {}

    def show(running: Running) -> None:
        for number, what, done, total in running:
            bar = bars.get(number)
            if bar is None:
                bar = bars[number] = tqdm(total=total, desc=what, leave=False)
            if total is not None:
                bar.total = total
            bar.n = done
            bar.refresh()
        for number in set(bars) - {of[0] for of in running}:
            bars.pop(number).close()

    return show
