"""Numbers as people and programs write them, by a writer that knows their value and nothing of how they are read.

Run as a script, it holds many of them against what is read: ``python tests/shared/number_spellings.py 100000``.
"""

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from random import Random

Spelling = tuple[str, Fraction]

_SCRIPTS = ["٠١٢٣٤٥٦٧٨٩", "۰۱۲۳۴۵۶۷۸۹", "०१२३४५६७८९", "０１２３４５６７８９", "𝟎𝟏𝟐𝟑𝟒𝟓𝟔𝟕𝟖𝟗"]
_RAISED = str.maketrans("0123456789-+", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺")
_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_VULGAR = {"¼": "1/4", "½": "1/2", "¾": "3/4", "⅓": "1/3", "⅔": "2/3", "⅛": "1/8", "⅞": "7/8", "⅕": "1/5"}
_TIMES = ["*", "×", "·", "•", "✕", "∗", "⋅", " x ", "x", "X", r"\cdot ", r"\times "]
_SEPARATORS = [",", ".", "'", "’", "_", " ", "\u2009", "\u202f", "\u00a0", r"\,", "{,}"]


def gap(random: Random) -> str:
    return random.choice(["", "", "", " ", "  "])


def minus(random: Random) -> str:
    return random.choice("---−–")


def whole(random: Random) -> Spelling:
    value = random.choice([random.randrange(12), random.randrange(100), random.randrange(10**6)])
    return str(value), Fraction(value)


def decimal(random: Random) -> Spelling:
    digits = "".join(random.choices("0123456789", k=random.randrange(1, 6)))
    before = str(random.choice([0, 0, random.randrange(10), random.randrange(2000)]))
    value = Fraction(int(before + digits), 10 ** len(digits))
    return f"{before if before != '0' or random.random() < 0.8 else ''}.{digits}", value


def quotient(random: Random) -> Spelling:
    above, below = random.randrange(40), random.randrange(1, 40)
    line = gap(random) + random.choice("////÷⁄∕") + gap(random)
    return f"{above}{line}{below}", Fraction(above, below)


def percent(random: Random) -> Spelling:
    text, value = random.choice([whole, decimal, vulgar])(random)
    return f"{text}{gap(random)}{random.choice(['%', '％', '٪', chr(92) + '%'])}", value / 100


def vulgar(random: Random) -> Spelling:
    sign = random.choice(list(_VULGAR))
    return sign, Fraction(_VULGAR[sign])


def mixed(random: Random) -> Spelling:
    above, below = sorted(random.sample(range(1, 30), 2))
    number = random.randrange(1, 30)
    sign = random.choice(list(_VULGAR))
    if random.random() < 0.4:
        return f"{number}{gap(random)}{sign}", number + Fraction(_VULGAR[sign])
    if random.random() < 0.2:
        small = f"{str(above).translate(_RAISED)}⁄{str(below).translate(_LOWERED)}"
        return f"{number}{gap(random)}{small}", number + Fraction(above, below)
    if random.random() < 0.2:
        return rf"{number}\frac{{{above}}}{{{below}}}", number + Fraction(above, below)
    return f"{number} {above}/{below}", number + Fraction(above, below)


def small_quotient(random: Random) -> Spelling:
    above, below = random.randrange(1, 20), random.randrange(1, 20)
    return f"{str(above).translate(_RAISED)}⁄{str(below).translate(_LOWERED)}", Fraction(above, below)


def scientific(random: Random) -> Spelling:
    text, value = random.choice([whole, decimal])(random)
    exponent = random.randrange(-4, 5)
    sign = "-" if exponent < 0 else random.choice(["", "+"])
    size = str(abs(exponent))
    value *= Fraction(10) ** exponent
    minus_ = minus(random) if exponent < 0 else sign
    written: list[Callable[[], str]] = [
        lambda: f"{text}{random.choice('eE')}{minus_}{size}",
        lambda: f"{text}{gap(random)}{random.choice('eE')}{gap(random)}{minus_}{gap(random)}{size}",
        lambda: f"{text}{gap(random)}{random.choice(_TIMES)}{gap(random)}10^{minus_}{size}",
        lambda: f"{text}{random.choice(_TIMES)}10^({minus_}{size})",
        lambda: f"{text}{random.choice(_TIMES)}10^{{{minus_}{size}}}",
        lambda: f"{text}{random.choice(_TIMES)}10**{minus_}{size}",
        lambda: f"{text}{random.choice(_TIMES)}10{(sign.replace('+', '') + size).translate(_RAISED)}",
        lambda: f"{text}*^{sign}{size}",
    ]
    if exponent < 0:  # the superscript is lost
        written.append(lambda: f"{text}{gap(random)}{random.choice(_TIMES)}{gap(random)}10{gap(random)}{minus_}{size}")
    return random.choice(written)(), value


def repeating(random: Random) -> Spelling:
    block = "".join(random.choices("0123456789", k=random.choice([1, 1, 1, 2, 3, 6])))
    fixed = "".join(random.choices("0123456789", k=random.choice([0, 0, 1, 2])))
    before = random.choice(["0", "0", "1", "12"])
    scale = 10 ** len(fixed)
    value = Fraction(int(before + fixed), scale) + Fraction(int(block), scale * (10 ** len(block) - 1))
    dots = random.choice(["...", "…", " ...", ".."])
    bar = "".join(f"{digit}\u0305" for digit in block)
    dotted = block + "\u0307" if len(block) == 1 else f"{block[0]}\u0307{block[1:]}\u0307"
    endings = [
        f"({block})", bar, dotted, block * random.choice([2, 3, 4]) + dots, rf"\overline{{{block}}}",
        rf"\bar{{{block}}}",
    ]  # fmt: skip
    return f"{before}.{fixed}{random.choice(endings)}", value


def separated(random: Random) -> Spelling:
    """A number with thousands separators, or with a decimal comma: what is meant is in the writer's mind."""
    value = random.randrange(1000, 10**7)
    mark = random.choice(_SEPARATORS)
    if mark == "." and value < 10**6:  # 903.227 is a decimal to everybody here
        mark = ","
    text = f"{value:,}".replace(",", mark)
    if random.random() < 0.4:
        text, digits = decimal(random)
        comma = random.choice([",", "{,}", "٫", "，"])
        return text.replace(".", comma), digits
    if random.random() < 0.4 and mark != ".":
        return f"{text}.5", value + Fraction(1, 2)
    if random.random() < 0.4 and mark != ",":
        return f"{text},5", value + Fraction(1, 2)
    return text, Fraction(value)


def of_a_program(random: Random) -> Spelling:
    text, value = decimal(random)
    above, below = random.randrange(20), random.randrange(1, 20)
    fraction = Fraction(above, below)
    return random.choice(
        [
            (f"np.float64({text})", value), (f"Decimal('{text}')", value), (f"Fraction({above}, {below})", fraction),
            (f"Rational({above},{below})", fraction), (rf"\frac{{{above}}}{{{below}}}", fraction),
            (rf"\dfrac{{{above}}}{{{below}}}", fraction),
            (rf"\frac{above % 10}{below % 9 + 1}", Fraction(above % 10, below % 9 + 1)),
            (f"Sqrt[{above * above}]", Fraction(above)), (f"np.sqrt({below**2})", Fraction(below)),
            (rf"\sqrt{{{below**2}}}", Fraction(below)), (rf"\sqrt[3]{{{below**3}}}", Fraction(below)),
            (f"√{above * above}", Fraction(above)),
            (f"∛{below**3}", Fraction(below)), (f"{above}^2", Fraction(above**2)),
            (f"{below}^{{-1}}", Fraction(1, below)), (f"{below}**-1", Fraction(1, below)),
            (f"{below}⁻¹", Fraction(1, below)),
        ]
    )  # fmt: skip


ATOMS = [
    whole,
    decimal,
    quotient,
    percent,
    vulgar,
    mixed,
    small_quotient,
    scientific,
    repeating,
    separated,
    of_a_program,
]
#: Those that may stand in a sum or product without brackets, whatever else stands there.
FACTORS = [whole, decimal, vulgar]


def signed(random: Random) -> Spelling:
    text, value = random.choice(ATOMS)(random)
    if random.random() < 0.3:
        return f"{minus(random)}{gap(random)}{text}", -value
    return (f"+{text}" if random.random() < 0.05 else text), value


def in_two_forms(random: Random) -> Spelling:
    """A number and the same again, perhaps rounded."""
    above, below = random.randrange(1, 40), random.choice([2, 3, 4, 5, 7, 8, 16, 20, 41])
    value = Fraction(above, below)
    rounded = f"{float(value):.{random.randrange(1, 5)}f}"
    exact = f"{above}/{below}"
    percents = f"{float(value * 100):.{random.randrange(3)}f}%"
    other = random.choice([rounded, percents, exact])
    shape = random.choice(
        [
            "{} ({})",
            "{}({})",
            "{} = {}",
            "{} ≈ {}",
            "{} (= {})",
            "{} (≈{})",
            "{} ~ {}",
            "{}={}",
            "{} or {}",
            "{}, i.e. {}",
        ]
    )
    return shape.format(exact, other), value


def product(random: Random) -> Spelling:
    """Two numbers with a sign between, in all spacings; a quotient's percent sign may belong to all of it."""
    (left, first), (right, second) = (random.choice([*FACTORS, percent, quotient])(random) for _ in range(2))
    sides = [left, right]
    if any(sign in right for sign in "/÷⁄∕%％٪"):
        sides[1] = f"({right})"
    if any(sign in left for sign in "/÷⁄∕") and random.random() < 0.9:
        sides[0] = f"({left})"
    if second and random.random() < 0.4:
        return f"{sides[0]}{gap(random)}/{gap(random)}{sides[1]}", first / second
    sign = random.choice([sign for sign in _TIMES if "\\" in sign or sign != "x"])
    return f"{sides[0]}{sign}{sides[1]}", first * second


def percent_of_a_quotient(random: Random) -> Spelling:
    above, below = random.randrange(1, 100), random.randrange(1, 30)
    value = random.choice([Fraction(above, below) / 100, Fraction(above * 100, below)])
    return f"{above}/{below}{gap(random)}%", value


def power(random: Random) -> Spelling:
    text, value = random.choice([whole, vulgar])(random)
    exponent = random.randrange(4)
    if random.random() < 0.3:  # the superscript of a half
        root = random.randrange(2, 12)
        return f"{root * root}^1/2", Fraction(root)
    value, text = (value % 50, str(value % 50)) if text.isdigit() else (value, text)
    return (
        f"{text}{random.choice([str(exponent).translate(_RAISED), f'^{exponent}', f'**{exponent}'])}",
        value**exponent,
    )


def total(random: Random) -> Spelling:
    (left, first), (right, second) = (random.choice([*FACTORS, percent, quotient])(random) for _ in range(2))
    if random.random() < 0.5:
        return f"{left}{gap(random)}+{gap(random)}{right}", first + second
    return f"{left}{gap(random)}{minus(random)}{gap(random)}{right}", first - second


def inside_a_product(random: Random) -> Spelling:
    text, value = signed(random)
    return random.choice([(f"2.0*{text}/2", value), (f"0.5 * {text} * 2", value), (f"2*({text})", 2 * value)])


def in_another_script(random: Random) -> Spelling:
    text, value = random.choice([whole, decimal, quotient, total])(random)
    digits = random.choice(_SCRIPTS)
    arabic = digits[0] in "٠۰" and random.random() < 0.7
    text = text.translate(str.maketrans("0123456789", digits))
    if random.random() < 0.1:  # a slip: one digit of another script
        text += "7"
        return text, Fraction(-12345678)
    return (text.replace(".", "٫") if arabic else text), value


def with_something_around(random: Random) -> Spelling:
    text, value = random.choice([signed, signed, in_two_forms, product, total])(random)
    around = random.choice(
        ["={}", "= {}", "≈ {}", "~{}", "{}.", '"{}"', "'{}'", "${}$", r"\({}\)", "({})", "x = {}", " {} ", "`{}`",
         "$${}$$", "approx. {}", "{} m", "{}€", "${}", "{}°", "[{}]", "\\left({}\\right)", "{}f"]
    )  # fmt: skip
    return around.format(text), value


SPELLINGS = [
    *ATOMS, signed, signed, in_two_forms, product, percent_of_a_quotient, power, total, inside_a_product,
    in_another_script, with_something_around, with_something_around,
]  # fmt: skip


def spellings(count: int, seed: int = 0) -> Iterator[tuple[str, Spelling]]:
    """Some numbers as they are written, with what they are worth, and which writer wrote them."""
    random = Random(seed)
    for _ in range(count):
        writer = random.choice(SPELLINGS)
        yield writer.__name__, writer(random)


def misread(count: int, seed: int = 0) -> tuple[Counter[tuple[str, str]], list[str]]:
    """How many were read and refused, by their writers; and those that were read as something else."""
    from rldrill.solutions.answers.text import Unreadable, read_number

    outcomes: Counter[tuple[str, str]] = Counter()
    wrong = []
    for writer, (text, value) in spellings(count, seed):
        try:
            reading = read_number(text)
        except Unreadable:
            outcomes[writer, "refused"] += 1
            continue
        right = str(reading.value) == str(value)
        outcomes[writer, "read" if right else "MISREAD"] += 1
        if not right:
            wrong.append(f"{text!r} is {value}, read as {reading.echo} = {reading.value}")
    return outcomes, wrong


if __name__ == "__main__":
    outcomes, wrong = misread(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    print(*wrong[:60], sep="\n")
    for writer in sorted({writer for writer, _ in outcomes}):
        print(f"{writer:22}", *(f"{what} {outcomes[writer, what]:6}" for what in ("read", "refused", "MISREAD")))
    print(
        {what: sum(n for (_, said), n in outcomes.items() if said == what) for what in ("read", "refused", "MISREAD")}
    )
