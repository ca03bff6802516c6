"""What was shown, what was recomputed, and whether every number of a report was."""
import fnmatch
import math

import numpy as np

EXACT = 1e-6
SINGLE = 3e-6  # means of distances whose products are in single precision
STORED = 2e-5  # of draws that are stored in single precision
# Fields whose numbers are wrong or worse than stated, reported and not yet corrected. One that is corrected may stay here
# until it is taken out: agreeing is never a fault.
KNOWN = {
}


def leaves(value, path=""):
    """(path, number) of every number in a JSON document; a list of numbers is one."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        if value and all(_is_number(part) for part in value):
            yield path, value
        else:
            for index, part in enumerate(value):
                yield from leaves(part, f"{path}.{index}" if path else str(index))
    elif _is_number(value):
        yield path, value


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def at(value, path):
    """The part of a JSON document at a path."""
    for key in path.split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


class Table:
    def __init__(self):
        self.rows = []
        self.unchecked = {}
        self.numbers = 0

    def case(self, name, report):
        return Case(self, name, report)

    def add(self, case, field, shown, found, off, bound, law):
        self.rows.append((case, field, shown, found, off, bound, law))

    @property
    def off(self):
        return [row for row in self.rows if not row[4] <= row[5]]

    @property
    def wrong(self):
        """Those that are not known to be."""
        return [row for row in self.off if row[1] not in KNOWN]

    def text(self, every):
        lines = []
        if self.unchecked:
            lines.append("Numbers of the reports that are not recomputed, and why:")
            by_reason = {}
            for (field, reason), cases in self.unchecked.items():
                by_reason.setdefault(reason, []).append(f"{field} ({len(cases)})")
            for reason, fields in by_reason.items():
                lines.append(f"  {reason}: {', '.join(sorted(fields))}")
            lines.append("")
        known = {}
        for row in self.off:
            if row[1] in KNOWN:
                known.setdefault(row[1], []).append(row[0])
        if known:
            lines.append("Known to be off:")
            lines += [f"  {field}: {KNOWN[field]} ({len(cases)} reports)" for field, cases in known.items()]
            lines.append("")
        shown = self.rows if every else self.off
        if shown:
            width = max(len(f"{row[0]}: {row[1]}") for row in shown)
            lines.append(f"{'name':{width}}  {'shown':>24} {'recomputed':>24} {'off by':>9} {'bound':>9}  law")
            for case, field, one, other, off, bound, law in shown:
                mark = "" if off <= bound else "  <-- OFF"
                name = f"{case}: {field}"
                lines.append(f"{name:{width}}  {_short(one):>24} {_short(other):>24} {off:9.1e} {bound:9.1e}  {law}{mark}")
            lines.append("")
        laws = {}
        for row in self.rows:
            laws.setdefault(row[6], []).append(row[4] / row[5] if row[5] else float(row[4] > 0))
        for law, shares in laws.items():
            lines.append(f"{law}: {len(shares)} entries, at most {max(shares):.2f} of the bound")
        lines.append(f"{len(self.rows)} entries with {self.numbers} numbers recomputed, {len(self.off)} off, "
                     f"{len(self.off) - len(self.wrong)} of them known.")
        return "\n".join(lines)


def _short(value):
    if value is None or isinstance(value, str) or (isinstance(value, list) and value and isinstance(value[0], str)):
        return str(value)
    value = np.atleast_1d(np.asarray(value, float)).ravel()
    return f"{value[0]:.12g}" if len(value) == 1 else f"{value[0]:.9g} ... [{len(value)}]"


class Case:
    """The numbers of one report. Every one of them must be compared or excused by the end."""

    def __init__(self, table, name, report):
        self.table, self.name, self.report, self.seen = table, name, report, set()

    def __contains__(self, path):
        try:
            return at(self.report, path) is not None
        except (KeyError, IndexError, TypeError):
            return False

    def shown(self, path):
        return at(self.report, path)

    def _record(self, path, shown, found, off, bound, law):
        self.seen.add(path)
        self.table.numbers += np.size(shown)
        self.table.add(self.name, path, shown, found, off, bound, law)

    def equal(self, path, found, bound=EXACT, scale=None, law="computed"):
        """Relative to the number itself, of a list to the number or a thousandth of the largest; or to `scale`."""
        shown = self.shown(path)
        one, other = np.asarray(shown, float), np.asarray(found, float)
        if one.shape != other.shape:
            self._record(path, shown, found, math.inf, bound, law)
            return
        size = np.maximum(np.abs(one), np.abs(other))
        if scale is not None:
            size = np.maximum(size, scale)
        elif one.ndim:
            size = np.maximum(size, 1e-3 * size.max(initial=0.0))
        off = np.where(one == other, 0.0, np.abs(one - other) / np.where(size > 0, size, 1.0))
        off = float(off.max(initial=0.0))
        self._record(path, shown, found, math.inf if math.isnan(off) else off, bound, law)

    def same(self, path, found):
        """A count, a name: no difference at all."""
        shown = self.shown(path)
        self._record(path, shown, found, 0.0 if shown == found else math.inf, 0.0, "counted")

    def near(self, path, found, error, law="random", times=5.0, also=True):
        """Within `times` standard errors; `also` says whether that is enough for the number to count as recomputed."""
        shown = self.shown(path)
        off = float(np.max(np.abs(np.asarray(shown, float) - np.asarray(found, float)) / np.maximum(error, 1e-300)))
        name = path if also else f"{path} (independent draws)"
        self.table.add(self.name, name, shown, found, off, times, f"{law}, in standard errors")
        if also:
            self.seen.add(path)
            self.table.numbers += np.size(shown)

    def finish(self, excused):
        """Numbers that nothing was compared with: those that are excused are listed, the others are wrong."""
        for path, value in leaves(self.report):
            if path in self.seen:
                continue
            reason = next((why for pattern, why in excused.items() if fnmatch.fnmatchcase(path, pattern)), None)
            field = ".".join("*" if key.isdigit() else key for key in path.split("."))
            if reason is None:
                self.table.add(self.name, path, value, math.nan, math.inf, 0.0, "not known to this script")
            else:
                self.table.unchecked.setdefault((field, reason), set()).add(self.name)
