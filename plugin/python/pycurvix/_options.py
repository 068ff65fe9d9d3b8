# SPDX-License-Identifier: BSD-3-Clause
"""The options of a run, by the names of the command line."""
from __future__ import annotations

import collections
import numbers
import os

from . import _core
from ._lazy import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import Any, Iterator, Mapping


class OptionInfo(collections.namedtuple('OptionInfo', 'name default range unit help symbol')):
    """What there is to know about an option."""

    __slots__ = ()

    name: str
    default: Any
    range: str  # '> 0', say; '': anything
    unit: str  # 'px', 'deg' or ''
    help: str
    symbol: str  # in the paper, or ''

    def __str__(self) -> str:
        allowed = ' '.join(filter(None, (self.range, self.unit)))
        symbol = f' ({self.symbol})' if self.symbol else ''
        return f'{self.name} = {self.default!r}{", " + allowed if allowed else ""}: {self.help}{symbol}'


def _text(value: Any) -> str:
    """As the command line has it."""
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if hasattr(value, 'item') and not hasattr(value, '__len__'):  # a number of NumPy
        value = value.item()
    if isinstance(value, bool):
        return '1' if value else '0'
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (list, tuple)):
        return ','.join(map(str, value))
    raise _core.ArgumentError(f'an option is a number, a text or a list of texts, not {value!r}')


class Options:
    """All options of ``colmap_curvix reconstruct``, by their names there.

    Parameters
    ----------
    values : mapping of str to value, optional
        What is not left at its default, or options to copy. As on the command
        line, a preset changes no value that is given, before or after it.
    **named : value
        Options whose names are identifiers: ``preset='paper'``.

    Raises
    ------
    ArgumentError
        There is no such option, or it does not take the value. Then nothing is
        set.

    Examples
    --------
    >>> options = pycurvix.Options({'CurveFilter.min_length_px': 20}, num_threads=4)
    >>> options['CurveFilter.min_num_views']
    0
    >>> print(options.about('CurveFilter.min_num_views'))
    >>> options['preset'] = 'paper'  # keeps what was set
    """

    __slots__ = ('_core',)

    def __init__(self, values: Mapping[str, Any] | Options | None = None, **named: Any) -> None:
        self._core = _core.Options()
        given = values._core.given if isinstance(values, Options) else values or {}
        self.update({**given, **named})

    def update(self, values: Mapping[str, Any]) -> None:
        """Set several options, or, if one of them cannot be set, none.

        Parameters
        ----------
        values : mapping of str to value
        """
        self._core.set([(name, _text(value)) for name, value in values.items()])

    def __getitem__(self, name: str) -> Any:
        return self._core.get(name)

    def __setitem__(self, name: str, value: Any) -> None:
        self.update({name: value})

    def __iter__(self) -> Iterator[str]:
        return iter(self._core.names())

    def __len__(self) -> int:
        return len(self._core.names())

    def __contains__(self, name: object) -> bool:
        return name in self._core.names()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Options) and dict(self.items()) == dict(other.items())

    __hash__ = None  # type: ignore[assignment]

    def keys(self) -> list[str]:
        """All names, in the order of the command line's help."""
        return self._core.names()

    def items(self) -> list[tuple[str, Any]]:
        """All names with their values."""
        return [(name, self[name]) for name in self]

    @staticmethod
    def about(name: str) -> OptionInfo:
        """Default, range, unit and help of an option.

        Parameters
        ----------
        name : str

        Returns
        -------
        OptionInfo
        """
        return OptionInfo(**_core.Options.about(name))

    def __repr__(self) -> str:
        default = _core.Options()
        if self['preset'] != 'default':
            default.set([('preset', self['preset'])])
        changed = {name: value for name, value in self.items() if name == 'preset' or value != default.get(name)}
        if changed['preset'] == 'default':
            del changed['preset']
        return f'Options({changed if changed else ""})'

    def _ipython_key_completions_(self) -> list[str]:
        return self.keys()


def core_options(options: Options | Mapping[str, Any] | None) -> _core.Options:
    """What functions take as options."""
    return (options if isinstance(options, Options) else Options(options))._core
