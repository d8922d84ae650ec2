"""The longest that any answer is judged, and the most memory it takes, where it is made to take long.

python benchmarks/hostile.py [FAMILY …]

To every part of a problem of every family and level, and to those after it, everything below is answered, in the shape
that the part asks for and without one.
"""

import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import suppress

from rldrill.exercise import Exercise, draw
from rldrill.problems.catalogue import families, family
from rldrill.problems.errors import UserError
from rldrill.problems.parts import Kind, Matrix, Numbers, Part, Policy, Values

PRIMES = [number for number in range(2, 400) if all(number % other for other in range(2, number))]
#: So many characters are read, and so many of the worst answers are told.
LONGEST, WORST = 2000, 10
#: From so many seconds on a time is taken three times, and the memory, too.
TOLD = 0.02


def joined(terms: Iterator[str], sign: str, length: int) -> str:
    """As many terms as fit."""
    text = next(terms)
    for term in terms:
        if len(text) + len(sign) + len(term) > length:
            break
        text += sign + term
    return text


def nested(before: str, within: str, after: str, length: int, most: int = 10**6) -> str:
    """As deep as fits."""
    depth = max(1, min(most, (length - len(within)) // (len(before) + len(after))))
    return before * depth + within + after * depth


#: What stands where a number is expected, of about so many characters.
NUMBERS: dict[str, Callable[[int, str], str]] = {
    "digits": lambda n, _: "9" * n,
    "quotient of digits": lambda n, _: f"{'9' * (n // 2 - 1)}/{'7' * (n // 2 - 1)}",
    "towers": lambda n, _: joined(iter(["9^64"] * n), "*", n),
    "powers of powers": lambda _, __: "(((9^64)^64)^64)^64",
    "fractions": lambda n, _: joined((f"1/{number}" for number in range(1001, 9999)), "+", n),
    "decimals": lambda n, _: joined((f"0.{number:039}" for number in range(10**38 + 1, 10**38 + 999)), "*", n),
    "roots": lambda n, _: joined((f"sqrt({prime})" for prime in PRIMES), "+", n),
    "one over roots": lambda n, _: f"1/({joined((f'sqrt({prime})' for prime in PRIMES), '+', n - 4)})",
    "quotients of roots": lambda n, _: joined((f"1/(1+sqrt({prime}))" for prime in PRIMES), "+", n),
    "roots of roots": lambda n, _: joined((f"sqrt({prime}+sqrt({prime}+sqrt(2)))" for prime in PRIMES), "+", n),
    "twelfth roots": lambda n, _: joined((f"{prime}^(1/12)" for prime in PRIMES), "+", n),
    "hidden zero": lambda _, __: "1/(sqrt(2)+sqrt(3)-sqrt(5+2*sqrt(6)))",
    "hidden zeros": lambda n, _: joined(iter(["sqrt(2)+sqrt(3)-sqrt(5+2*sqrt(6))"] * n), "+", n),
    "hidden tie": lambda n, _: joined(iter(["max(sqrt(2)+sqrt(3), sqrt(5+2*sqrt(6)))"] * n), "+", n),
    "logarithms": lambda n, _: joined((f"ln({prime})" for prime in PRIMES), "*", n),
    "hidden zero of logarithms": lambda _, __: "1/(ln(6)-ln(2)-ln(3))",
    "exponentials": lambda n, _: joined((f"exp({number}/97)" for number in range(1, 97)), "+", n),
    "power of exponentials": lambda n, _: f"({joined((f'exp({k}/7)' for k in range(1, 60)), '+', n - 5)})^64",
    "quotients of exponentials": lambda n, _: joined((f"1/(1+exp({k}/7))" for k in range(1, 99)), "+", n),
    "exponentials of roots": lambda n, _: joined((f"exp(sqrt({prime}))" for prime in PRIMES), "*", n),
    "angles": lambda n, _: joined((f"sin({number})^2" for number in range(1, 99)), "+", n),
    "tangents": lambda n, _: joined((f"tan({number}/7)" for number in range(1, 99)), "/", n),
    "greatest": lambda n, _: joined((f"max(sqrt({prime}), ln({prime}), {prime}/7)" for prime in PRIMES), "-", n),
    "absolute values": lambda n, _: nested("abs(1-", "sqrt(2)", ")", n, 39),
    "brackets": lambda n, _: nested("(", "1", ")", n),
    "forty brackets": lambda n, _: nested("(1+", "1", ")/3", n, 39),
    "roots in one another": lambda n, _: nested("sqrt(1+", "2", ")", n),
    "four roots in one another": lambda n, _: nested("sqrt(1+", "2", ")", n, 4),
    "fractions in one another": lambda n, _: nested("\\frac{1}{1+", "2", "}", n),
    "forty fractions in one another": lambda n, _: nested("1/(1+", "2", ")", n, 39),
    "signs": lambda n, _: "-" * (n - 1) + "1",
    "root signs": lambda n, _: "√" * (n - 1) + "2",
    "small fractions": lambda n, _: "½" * n,
    "raised digits": lambda n, _: "2" + "⁹" * (n - 1),
    "accents": lambda n, _: "1" + "\u0301" * (n - 1),
    "full width": lambda n, _: "９" * n,
    "name": lambda n, _: "a" * n,
    "names": lambda n, _: joined(iter(["a b_1"] * n), " ", n),
    "forms": lambda n, _: joined(iter(["1"] * n), "=", n),
    "wrong by little": lambda _, __: "1.0000000000000000000000000000001",
    "letter left open": lambda n, x: joined((f"1/({k}+{x})" for k in range(1, 999)), "+", n),
    "power of it": lambda _, x: f"((1+{x})^24)/((2+{x})^24)",
    "quotients of powers of it": lambda n, x: joined((f"(1+{x})^12/(2+{x})^{k}" for k in range(1, 13)), "-", n),
    "exponentials of it": lambda n, x: joined((f"exp({k}*{x})" for k in range(1, 100)), "/", n),
    "roots of it": lambda n, x: joined((f"sqrt({k}+{x})" for k in range(1, 99)), "+", n),
}
#: What is answered as a whole, whatever the shape.
WHOLES = [
    *(sign * 1999 for sign in ",;:[]={}|()^_$\\%−\n\x00\u202e🤖a"), "1," * 999, "1;" * 999, "1\n" * 999, "1 " * 999,
    "a: 1, " * 333, "a=1\n" * 499, "[1, 2; " * 285, "[[1],[2]]," * 199, "array([[1., 2.],\n" * 117, "tensor(" * 285,
    "Matrix([" * 249, "{'a': 1, " * 222, "np.float64(" * 181, "Fraction(" * 222, "\\begin{pmatrix}1&2\\\\" * 95,
    "()" * 999, "1&" * 999, "yes" * 666, "9" * 10**5, "(" * 10**5, "1+" * 10**5, "a: " * 10**5, "1/0", "0/0",
    "nan", "inf", "1e999999999", "1e-999999999", "3,5; 2,5", "1..2", "1e1e1", "0x10", "1_000", "٣", "", " ",
]  # fmt: skip


def shaped(number: Callable[[int, str], str], kind: Kind, letter: str) -> str:
    """A hostile number in every place of an answer of that kind, as long as may be."""
    match kind:
        case Numbers(entries):
            one = number((LONGEST - 2 * len(entries)) // len(entries), letter)
            return ", ".join([one] * len(entries))
        case Matrix(rows, columns):
            one = number((LONGEST - 4 * rows * columns) // (rows * columns), letter)
            return "[" + "; ".join(", ".join([one] * columns) for _ in range(rows)) + "]"
        case Values(_, keys):
            names = [key if isinstance(key, str) else f"({', '.join(key)})" for key in keys]
            one = number(max(8, (LONGEST - sum(len(name) + 4 for name in names)) // len(names)), letter)
            return ", ".join(f"{name}: {one}" for name in names)
        case Policy(actions):
            return ", ".join(f"{state}: {number(LONGEST // len(actions) - 20, letter)}" for state in actions)
        case _:
            return number(LONGEST, letter)


def submissions(exercise: Exercise, first: Part) -> Iterator[tuple[str, dict[str, str]]]:
    """Hostile answers to a part and all after it, which are judged as what follows from it, too; each with a name."""
    letter = next(iter(exercise.problem.parameters), "gamma")
    parts = [part for part in exercise.parts if part.label >= first.label]
    for name, number in NUMBERS.items():
        yield name, {part.label: shaped(number, part.kind, letter) for part in parts}
    for whole in WHOLES:
        yield f"{whole[:12]!r} × {len(whole)}", {part.label: whole for part in parts}


def judged(exercise: Exercise, typed: dict[str, str]) -> None:
    """Judge a submission."""
    with suppress(UserError):
        exercise.grade(typed)


def taken(exercise: Exercise, typed: dict[str, str]) -> float:
    """The processor time of judging a submission, in seconds for each of its answers."""
    begun = time.process_time()
    judged(exercise, typed)
    return (time.process_time() - begun) / len(typed)


def main(names: list[str]) -> None:
    """Print the worst by time and by memory."""
    slow: list[tuple[float, str]] = []
    large: list[tuple[float, str]] = []
    count = 0
    for name in names:
        for level in family(name).levels:
            exercise = draw(name, level, 3)
            for part in exercise.parts:
                judged(exercise, {part.label: "1"})  # what is worked out once for a problem is no answer's doing
                for called, typed in submissions(exercise, part):
                    count += len(typed)
                    where = f"{name}/{level} ({part.label})  {called}"
                    seconds = taken(exercise, typed)
                    if seconds > TOLD:  # a busy machine takes longer, now and then
                        seconds = min(seconds, taken(exercise, typed), taken(exercise, typed))
                    slow.append((seconds, where))
                    if seconds > TOLD:  # what takes much memory takes its time
                        tracemalloc.start()
                        judged(exercise, typed)
                        large.append((tracemalloc.get_traced_memory()[1] / 2**20, where))
                        tracemalloc.stop()
    print(f"{count} answers")
    for title, found, unit in (("slowest", slow, "ms"), ("largest", large, "MB")):
        print(title)
        for size, where in sorted(found, reverse=True)[:WORST]:
            print(f"  {size * (1000 if unit == 'ms' else 1):8.1f} {unit}  {where}")


if __name__ == "__main__":
    main(sys.argv[1:] or list(families()))
