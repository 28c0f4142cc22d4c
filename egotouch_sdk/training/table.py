"""Scores of several runs as a table to print."""

from __future__ import annotations

from collections.abc import Mapping

#: Columns of the table: heading, score and format; shares in percent.
_COLUMNS = (("pictures", "pictures", "d"), ("AUROC", "auroc", ".4f"), ("accuracy", "accuracy", ".1%"), ("TPR", "true_positive_rate", ".1%"),
            ("FPR", "false_positive_rate", ".1%"), ("force N", "force_mae_n", ".3f"), ("force rho", "force_spearman", ".3f"))  # fmt: skip


def score_table(scores: Mapping[str, Mapping[str, float]], mean: bool) -> str:
    """Lines of a table of scores by name, with their mean over the rows where `mean` asks for it."""
    rows = [(name, [row[key] for _, key, _ in _COLUMNS]) for name, row in scores.items()]
    if mean and len(rows) > 1:
        columns = [[values[k] for _, values in rows] for k in range(len(_COLUMNS))]
        rows.append(("mean", [sum(columns[0]), *(sum(column) / len(column) for column in columns[1:])]))
    width = max([5, *(len(name) for name, _ in rows)])
    lines = [" " * width + "".join(f"{heading:>11}" for heading, _, _ in _COLUMNS)]
    for name, values in rows:
        lines.append(f"{name:<{width}}" + "".join(f"{value:>11{form}}" for value, (_, _, form) in zip(values, _COLUMNS, strict=True)))
    return "\n".join(lines) + "\n"
