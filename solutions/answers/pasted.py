"""What programs print (numpy, MATLAB, LaTeX, JSON, tables, rldrill itself) in the marks that people type.

Signs become other signs or blanks, one for one, so that complaints still name the right column; only matrices in
brackets of several lines, and numbers that are longer than a line, are put together anew.
"""

import re
from collections.abc import Callable, Collection, Iterator, Sequence

from rldrill.problems.expressions import GREEK
from rldrill.problems.spelling import Unreadable

_PIECES = re.compile("[⎡⎢⎣⎛⎜⎝⎧⎨⎩]([^⎡⎢⎣⎤⎥⎦⎛⎜⎝⎞⎟⎠⎧⎨⎩⎫⎬⎭\n]*)[⎤⎥⎦⎞⎟⎠⎫⎬⎭]")
_TOP = re.compile("[⎡⎛⎧]")
_PIECE = re.compile("[⎡⎢⎣⎛⎜⎝⎧⎨⎩]")

_LETTERS = GREEK | {
    **{f"var{name}": GREEK[name] for name in ("epsilon", "theta", "rho", "sigma", "phi")},
    "pi": "π", "Sigma": "Σ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "partial": "∂", "nabla": "∇",
    "to": "→", "rightarrow": "→", "Rightarrow": "→", "longrightarrow": "→", "mapsto": "→", "leftarrow": "←",
    "uparrow": "↑", "downarrow": "↓", "mid": "|", "vert": "|", "ast": "*", "star": "*", "top": "⊤", "intercal": "⊤",
    "approx": "≈", "simeq": "≈", "left": " ", "right": " ", "quad": " ", "qquad": " ", "_": "_", "%": "%", "&": "&",
    "#": "#", "{": "{", "}": "}", ",": " ", ";": " ", ":": " ", "!": " ", " ": " ", "[": " ", "]": " ", "(": " ",
    ")": " ", "max": "max", "min": "min", "displaystyle": " ",
}  # fmt: skip
_COMMAND = re.compile(rf"\\(?:({'|'.join(filter(str.isalpha, _LETTERS))})(?![A-Za-z])|([_%&#{{}},;:! \[\]()]))")
_WORDS = re.compile(r"\\(?:text(?:rm|bf|it)?|math(?:rm|sf|bf|it|bb)|boldsymbol|mbox|operatorname\*?)\s*\{([^{}\\]*)\}")
_ACCENTS = {"hat": "\u0302", "widehat": "\u0302", "bar": "\u0304", "overline": "\u0304", "tilde": "\u0303"}
_ACCENT = re.compile(rf"\\({'|'.join(_ACCENTS)})\s*\{{\s*([^\W\d_])\s*\}}")
_SLOPE = re.compile(r"\\[dt]?frac\s*\{\s*([∂d])\s*(\w*)\s*\}\s*\{\s*([∂d])\s*(\w+(?:_\{?\w+\}?)?)\s*\}")
_ENVIRONMENT = re.compile(
    r"\\begin\s*\{([a-zA-Z]+)\*?\}(?:\s*\{[lcr|@ ]*\})?|\\end\s*\{[a-zA-Z]+\*?\}|&"
    r"|\\\\(?:\s*\[[^\]\n]{0,9}\])?(?:\s*(?=\\end))?"
)
_OVER = re.compile(r"\{([^{}\\]*)\\over(?![A-Za-z])([^{}\\]*)\}")
_GRIDS = frozenset({"matrix", "pmatrix", "bmatrix", "Bmatrix", "vmatrix", "Vmatrix", "smallmatrix", "array", "tabular"})

_ESCAPED = re.compile(r"(?:\\u[0-9a-fA-F]{4})+")

_ARRAYS = re.compile(
    r"array|asarray|mat|[Mm]atrix|Immutable(?:Dense)?Matrix|[tT]ensor|(?:Device)?Array|list|tuple|(?:frozen)?set|dict|"
    r"OrderedDict|defaultdict|Counter|Series|DataFrame|c"
)
_NUMBERS = re.compile(r"(?:float|int|double|longdouble|str_|mpf|mpq|fmpq|Fraction|Rational|Decimal|Integer|Float)\d*_?")
_CALL = re.compile(r"(?:\b[A-Za-z_]\w*\.)*\b([A-Za-z_]\w*)\(")
_OPTION = re.compile(r",\s*[A-Za-z_]\w*\s*=")
_TYPE = re.compile(r"<[^<>\n]*>\s*,")

_CONTINUED = re.compile(r"(?<=[\s,;\[])\.\.\.[^\S\n]*\n")
#: Nobody puts so many digits on a line and then others that go with them: the terminal's edge tore the number.
_TORN = re.compile(r"(?<=[0-9/]{40})\n[^\S\n]*(?=[0-9/]+[^\S\n]*(?:\n|\Z))")
#: A sign of equality on a line of its own.
_ALONE = re.compile(r"\n[^\S\n]*[=≈][^\S\n]*\n")
_FOLLOWS = re.compile(r"\n\s*(?=[=≈])(?!==)")
_HEADER = re.compile(r"\A\s*(?:\d+(?:×\d+|-element) [^\n:]*:[^\S\n]*(?=\n)|\[1\](?=\s+[-+.\d]))")
_FOOTER = re.compile(r"\n(?:Name: [^\n]*?)?(?:dtype|Length): [^\n]*\Z")
_ITEM = re.compile(r"[^\S\n]*(?:([-–+*•‣◦])|([0-9]{1,2}|[a-z])([.)])|\(([0-9]{1,2}|[a-z])\))[^\S\n]+(?=\S)")
_LABELLED = re.compile(r"^(\s*)\(?([0-9]{1,2}|[a-z])\)", re.MULTILINE)
_SIGNED, _SAID = re.compile(r"[-–+−]"), re.compile(r"[^\W\d_][^=:≈\n]*[=:≈]")
_AND = re.compile(r"(?<=[0-9)\]}πγ%])(?:,|[^\S\n])[^\S\n]*and[^\S\n]+(?=[^\s])")
_STRONG = re.compile(r"(?<![\w)\]])\*\*([^\W\d_][^*\n]*)\*\*")
_LINES = "-─━═|│┃+┼╇┿╪├┤┌┐└┘┬┴╭╮╰╯╞╡┡┩"
_RULE = re.compile(rf"^(?=[^\n]*[-─━═])(?=[^\n]*[{_LINES}]{{3}})[{_LINES}:= \t]+$", re.MULTILINE)
_EDGE = re.compile(r"^[^\S\n]*[|│┃]|[|│┃][^\S\n]*$", re.MULTILINE)
_TAB = re.compile(r"(?<=[^\s,;:=|(\[{])( *)\t( *)(?=[^\s,;:=|)\]}])")


def laid_out(text: str) -> str:
    """What was pasted, in the marks that people type; ``|`` parts the cells of a table.

    Raises:
        Unreadable: the dashes before all lines may be minus signs, or those of a list.
    """
    text = _ESCAPED.sub(_in_place(_unescaped), text)
    for change in (_stacked_matrices, in_signs, _calls, _tables, _prose):
        text = change(text)
    return text


def _in_place(new: Callable[[re.Match[str]], str]) -> Callable[[re.Match[str]], str]:
    """A replacement that is moved to the right end of what it replaces, so that nothing else moves."""
    return lambda match: new(match).rjust(len(match[0]))


def _unescaped(match: re.Match[str]) -> str:
    """JSON's escapes as characters; they stay escapes where they stand for no characters that can be seen."""
    written = bytes.fromhex("".join(match[0].split("\\u"))).decode("utf-16-be", errors="replace")
    return written if written.isprintable() else match[0]


def _blank(match: re.Match[str]) -> str:
    return " " * len(match[0])


def _stacked_matrices(text: str) -> str:
    """Matrices whose brackets are put together from pieces, one line for each row, as rows on one line."""
    if not _PIECE.search(text):
        return text
    blocks: list[list[str]] = []
    stacked = False
    for line in text.split("\n"):
        was, stacked = stacked, bool(_PIECE.search(line))
        if blocks and was and stacked and not _TOP.search(line):
            blocks[-1].append(line)
        else:
            blocks.append([line])
    return "\n".join(_one_line(block) for block in blocks)


def _one_line(lines: list[str]) -> str:
    """Some matrices side by side, and what stands between them in any of the lines."""
    pieces = [list(_PIECES.finditer(line)) for line in lines]
    if len({len(row) for row in pieces}) != 1:
        return "\n".join(lines)
    ends = [[0, *(piece.end() for piece in row)] for row in pieces]
    starts = [[*(piece.start() for piece in row), len(line)] for row, line in zip(pieces, lines, strict=True)]
    whole = ""
    for place in range(len(pieces[0]) + 1):
        between = (line[ends[row][place] : starts[row][place]] for row, line in enumerate(lines))
        whole += " ".join(" ".join(between).split())
        if place < len(pieces[0]):
            rows = (row[place][1].strip() for row in pieces)
            whole += f"[{';'.join(re.sub(' {2,}', ',', row) + ',' for row in rows if row)}]"
    return whole


def in_signs(text: str) -> str:
    """LaTeX's matrices, aligned lines, letters and words; its fractions and roots are left as they are."""
    if "\\" not in text:
        return text
    open_: list[bool] = []

    def environment(match: re.Match[str]) -> str:
        if match[1]:
            open_.append(match[1] in _GRIDS)
            return "[" if open_[-1] else ""
        grid = bool(open_) and open_[-1]
        if match[0].startswith("\\\\") and match.string.startswith("\\end", match.end()):
            return ""
        if match[0].startswith("\\end"):
            return ",]" if open_ and open_.pop() else ""
        if match[0] == "&":
            return ("," if grid else " ") if open_ else "&"
        return ",;" if grid else "\n"

    text = _OVER.sub(lambda match: f"(({match[1]})/({match[2]}))", text)
    text = _WORDS.sub(_in_place(lambda match: match[1]), text)
    text = _ENVIRONMENT.sub(_in_place(environment), text)
    text = _COMMAND.sub(_in_place(lambda match: _LETTERS[match[1] or match[2]]), text)
    text = _ACCENT.sub(_in_place(lambda match: match[2] + _ACCENTS[match[1]]), text)
    return _SLOPE.sub(_in_place(lambda match: f"{match[1]}{match[2]}/{match[3]}{match[4]}"), text)


def _calls(text: str) -> str:
    """What Python, Julia and R print around numbers: ``array([…], dtype=float32)``, ``np.float64(3.5)``."""
    signs = list(text)
    pairs = dict(_bracketed(text)) if "(" in text else {}
    for match in _CALL.finditer(text):
        name, start = match[1], match.end()
        stop = pairs.get(start - 1)
        if stop is None or not (_ARRAYS.fullmatch(name) or _NUMBERS.fullmatch(name)):
            continue
        if name == "c" and (text[: match.start()].strip() or text[stop + 1 :].strip()):  # R's, not the state c
            continue
        array = bool(_ARRAYS.fullmatch(name))
        inside = _TYPE.match(text, start)
        start = inside.end() if inside else start
        depth = 0
        for index in range(start, stop):
            depth += (text[index] in "([{") - (text[index] in ")]}")
            if not depth and text[index] == "," and _OPTION.match(text, index):
                signs[index:stop] = " " * (stop - index)
                break
            if not depth and text[index] == "," and not array:
                signs[index] = "/"  # Fraction(1, 4)
        for index in (*range(match.start(), start - (not array)), *([stop] if array else [])):
            signs[index] = " "
    return "".join(signs)


def _bracketed(text: str) -> Iterator[tuple[int, int]]:
    """Where round brackets open, and where they are closed."""
    waiting: list[int] = []
    for index, sign in enumerate(text):
        if sign == "(":
            waiting.append(index)
        elif sign == ")" and waiting:
            yield waiting.pop(), index


def _tables(text: str) -> str:
    """Cells parted by ``|``, whatever parted them, without the lines that are drawn around them."""
    text = _CONTINUED.sub(_blank, text)
    text = _TORN.sub("", text)
    text = _ALONE.sub(lambda match: match[0].replace("\n", " "), text)
    text = _FOLLOWS.sub(_blank, text)
    text = _HEADER.sub(_blank, text)
    text = _FOOTER.sub(_blank, text)
    text = _RULE.sub(_blank, text)
    text = _EDGE.sub(_blank, text)
    text = _TAB.sub(lambda match: f"{match[1]}|{match[2]}", text)
    return text.replace("│", "|").replace("┃", "|")


def _prose(text: str) -> str:
    """Lists as one writes them, with dashes, dots or numbers before the lines; bold names; and "and" for a comma."""
    text = _STRONG.sub(lambda match: f"  {match[1]}  ", text)
    text = _AND.sub(lambda match: ",".ljust(len(match[0])), text)
    lines = [line for line in text.split("\n") if line.strip()]
    items = [_ITEM.match(line) for line in lines]
    if len(lines) < 2 or not all(items) or not _is_list([(item, item.string[item.end() :]) for item in items if item]):
        return text
    return "\n".join(_blank(item) + line[item.end() :] if (item := _ITEM.match(line)) else line
                     for line in text.split("\n"))  # fmt: skip


def keyed_list(text: str, names: Collection[object]) -> str:
    """A list whose numbers or letters are names of what is asked for, as a table by name: ``(1) 3`` is ``1: 3``."""
    lines = [line for line in text.split("\n") if line.strip()]
    items = [_ITEM.match(line) for line in lines]
    if len(lines) < 2 or not all(item and (item[4] or (item[3] == ")" and item[2])) in names for item in items):
        return text
    return _LABELLED.sub(lambda label: f"{label[1]}{label[2]}:".rjust(len(label[0])), text)


def _is_list(lines: Sequence[tuple[re.Match[str], str]]) -> bool:
    """Whether what stands before the lines makes a list of them, not numbers.

    Raises:
        Unreadable: it may do so, or be the signs of the numbers.
    """
    marks = {item[1] for item, _ in lines}
    if None in marks:
        counted = [item[2] or item[4] for item, _ in lines]
        first = "123456789" if counted[0] == "1" else "abcdefghi"
        dotted = any(item[3] == "." for item, _ in lines)  # 1. 2. may be numbers, as numpy prints them
        return counted == [*first[: len(lines)]] and not (dotted and not all(_SAID.match(said) for _, said in lines))
    if len(marks) > 1:
        return False
    if not marks & {"-", "–", "+"} or all(_SAID.match(said) for _, said in lines):
        return True
    if any(_SIGNED.match(said) for _, said in lines):
        return True
    sign, number = min(marks), lines[0][1].strip()[:20]
    raise Unreadable(
        f"'{sign} {number}' may be '{sign}{number}', or '{number}' in a list with dashes; leave the spaces or the "
        "dashes out."
    )
