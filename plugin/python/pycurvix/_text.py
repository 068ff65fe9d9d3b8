# SPDX-License-Identifier: BSD-3-Clause
"""Text for people."""


def plural(count: int, noun: str) -> str:
    """'1 view', '2 views'."""
    return f'{count} {noun}' + ('' if count == 1 else 's')
