"""Log-likelihoods at the best fit, the criterion of both models, and the smaller one."""

from collections.abc import Callable, Mapping
from functools import lru_cache, reduce
from string import ascii_uppercase
from typing import Any, TypeAlias

import sympy

from rldrill.problems.bayes.bic import Data, Given
from rldrill.problems.document import Equation, joined
from rldrill.problems.exact import needed, shown
from rldrill.solutions.exact import NoSolution, Value, equals, exact, near, order, sign, simplest, tidy, to_sympy, told
from rldrill.solutions.formula.elimination import multiple
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.nodes.leaves import leaf
from rldrill.solutions.formula.notation import n as count
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bayes import (
    AIC_FOR_BIC,
    BIC,
    BIC_FOR_AIC,
    BIC_LOG_10,
    BIC_SIGN,
    BIC_WITHOUT_LOG,
    COIN_ML,
    LOG_LIKELIHOOD,
    akaike,
    share_of_each,
)
from rldrill.solutions.work import Equality, Step, Work


def solve(given: Given, work: Work) -> None:
    """The log-likelihoods, unless they are given; the criteria; the winner."""
    _compare(given, work, better=-1)


#: The number of data at which both are equal, from the quotient of the likelihoods and of how many parameters there are
#: more in the richer model.
Border: TypeAlias = Callable[[sympy.Expr, int], Any]


def _number_of_data(ratio: sympy.Expr, more: int) -> Any:
    return simplest(ratio ** sympy.Rational(2, more))


def _compare(given: Given, work: Work, better: int, border: Border = _number_of_data) -> None:
    """The model wins of which the sign of its criterion minus any other's is ``better``."""
    names = given.names
    if given.border:
        _border(given, work, better, border)
        return
    fit = {}
    if given.fitted is not None:
        n = exact(given.n or 0)
        free = {name: exact(model.k) for name, model in given.fitted.items()}
    else:
        assert given.data is not None
        n = exact(sum(map(sum, given.data.tosses.values())))
        free = {name: exact(free_parameters(given.data, name)) for name in names}
        fit = work.answer({name: _fit(work, given.data, name) for name in names})
    formula = BIC if given.criterion == "BIC" else akaike()
    criteria = {}
    work.recall(formula)
    if given.criterion == "BIC" and (prime_factors := _taken_apart(n)):
        work.say(f"${prime_factors}$")
    for name in names:
        logarithm = fit[name] if fit else _logarithm(given, name, work)
        criteria[name] = work.step(formula, M=name, log_likelihood=logarithm, free=free[name], n=n)
    criteria = work.answer(criteria)
    work.answer(_winner(work, given, criteria, better))


@lru_cache(maxsize=256)
def _taken_apart(number: Value) -> str:
    """The logarithm of a number in those of primes; nothing where it is one already."""
    if sign(number) <= 0 or number == 1:
        return ""
    written = to_sympy(tidy(sympy.log(to_sympy(number))))
    factor, logarithm = written.as_coeff_Mul()
    if factor == 1 and isinstance(logarithm, sympy.log):
        return ""
    terms = sorted(
        (term.as_coeff_Mul() for term in sympy.Add.make_args(written)),
        key=lambda term: (bool(term[0] < 0), int(term[1].args[0])),
    )
    parts = [f"{'−' if n < 0 else '+'} {'' if abs(n) == 1 else f'{abs(n)} '}ln {log_.args[0]}" for n, log_ in terms]
    of = f"({told(number)})" if "/" in told(number) else f" {told(number)}"
    return f"ln{of} = {' '.join(parts).removeprefix('+ ')}".replace("= − ", "= −")


def _logarithm(given: Given, name: str, work: Work) -> Value:
    """The log-likelihood of a fitted model; of one part in a power it is told how it is found."""
    assert given.fitted is not None
    model = given.fitted[name]
    if model.likelihood is None:
        return exact(needed(model.log_likelihood))
    value = tidy(sympy.log(to_sympy(exact(model.likelihood))))
    factor, logarithm = to_sympy(value).as_coeff_Mul()
    if factor < 0 and isinstance(logarithm, sympy.log):
        power = "" if factor == -1 else f"{-factor} "
        work.say(f'$ln p(D_z|"{name}", θ̂) = ln({shown(model.likelihood)}) = −{power}ln {logarithm.args[0]}$')
    return value


def free_parameters(data: Data, model: str) -> int:
    """How many probabilities a model fits."""
    return {"fair": 0, "shared": 1, "own": len(data.tosses)}[model]


def _fit(work: Work, data: Data, model: str) -> Value:
    heads = {coin: exact(counts[0]) for coin, counts in data.tosses.items()}
    tails = {coin: exact(counts[1]) for coin, counts in data.tosses.items()}
    several = len(heads) > 1
    counts = f", with {_added('1', heads)} heads and {_added('0', tails)} tails of all coins"
    work.say(f"The model “{model}”{counts if several and model == 'shared' else ''}:")
    if model == "own" and several:
        theta: dict[str, Any] = {
            coin: work.step(share_of_each(), heads_of=heads, tails_of=tails, coin=coin) for coin in heads
        }
    else:
        share = (
            exact(1) / 2
            if model == "fair"
            else work.step(COIN_ML, heads=sum(heads.values(), exact(0)), tails=sum(tails.values(), exact(0)))
        )
        theta = dict.fromkeys(heads, share)
        work.say(f"$θ̂_c {equals(share)}${' for every coin' if several else ''}")
    taken_apart = dict.fromkeys(_taken_apart(chance) for share in theta.values() for chance in (share, 1 - share))
    if told_apart := ", ".join(filter(None, taken_apart)):
        work.say(f"${told_apart}$")
    known = {"heads_of": heads, "tails_of": tails, "theta_of": theta, "coins": tuple(heads)}
    value = work.step(LOG_LIKELIHOOD, M=model, **known)
    if work.lines and isinstance(last := work.lines[-1], Step):
        work.lines[-1] = _Collected(*last)
    return value


def _added(index: str, counts: Mapping[str, Value]) -> str:
    """How often all coins fell on a side, ``n₁ = 16 + 2 = 18``."""
    return f"$n_{index} = {' + '.join(map(told, counts.values()))} {equals(sum(counts.values(), exact(0)))}$"


class _Collected(Step):
    """A sum of logarithms, of which equal ones are put together and taken apart into those of primes."""

    def _written(self) -> Equation:
        plain = super()._written()
        times: dict[Any, Any] = {}
        for coin, share in self.known["theta_of"].items():
            for chance, side in ((share, "heads_of"), (1 - share, "tails_of")):
                if sign(chance) > 0:
                    times[chance] = times.get(chance, 0) + self.known[side][coin]
        collected = _sum(times, lambda chance: sympy.log(leaf(chance), evaluate=False))
        apart = _sum(times, lambda chance: leaf(tidy(sympy.log(to_sympy(chance)))))
        rights = tuple(dict.fromkeys((plain.rights[0], typeset(collected), typeset(apart), plain.rights[-1])))
        return Equation(plain.left, rights, ("=",) * len(rights))


def _sum(times: Mapping[Value, Value], logarithm: Callable[[Value], Any]) -> sympy.Expr:
    terms = [sympy.Mul(leaf(count), logarithm(chance), evaluate=False) for chance, count in times.items()]
    return terms[0] if len(terms) == 1 else sympy.Add(*terms, evaluate=False)


def _border(given: Given, work: Work, better: int, border: Border) -> None:
    """The number of data at which what the richer model gains is what its parameters cost."""
    assert given.fitted is not None
    simple, rich = sorted(given.fitted, key=lambda name: given.fitted[name].k)  # type: ignore[index]
    models = given.fitted[rich], given.fitted[simple]
    work.recall(BIC)
    fit = {}
    for name, model in given.fitted.items():
        fit[name] = _logarithm(given, name, work)
        known = {"M": name, "log_likelihood": fit[name], "free": exact(model.k)}
        work.lines.append(Step(BIC, BIC.right, known, None, "="))
    work.say(f"It is the same for both, {rich} on the left and {simple} on the right, if")
    sides = [
        sympy.Add(
            to_sympy(tidy(-2 * to_sympy(fit[name]))),
            multiple(exact(given.fitted[name].k), sympy.log(count)),
            evaluate=False,
        )
        for name in (rich, simple)
    ]
    more = models[0].k - models[1].k
    gained = to_sympy(fit[rich]) - to_sympy(fit[simple])
    ratio = to_sympy(exact(needed(models[0].likelihood)) / exact(needed(models[1].likelihood)))
    n = border(ratio, more)
    work.lines.append(Equality(sides[0], (sides[1],)))
    work.lines.append(Equality(multiple(exact(more), sympy.log(count)), (tidy(2 * gained),)))
    if more != 1:
        work.lines.append(Equality(sympy.log(count), (tidy(2 * gained / more),)))
    work.lines.append(Equality(count, (n,)))
    work.answer(n)
    cost, preferred = ("more", simple) if given.border == "more" else ("less", rich)
    work.say(
        f"With {given.border} data and the same likelihoods every parameter costs {cost}, so that the BIC prefers "
        f"{preferred}."
    )
    chosen = preferred if better < 0 else (rich if preferred == simple else simple)
    work.answer(ascii_uppercase[given.names.index(chosen)])


def _decimals(value: Value) -> str:
    """Four digits; more where these are zeros behind a whole number, which it is not."""
    rounded = [near(value, digits) for digits in (4, 5, 6)]
    return next((number for number in rounded if "." in number), rounded[0])


def _winner(work: Work, given: Given, criteria: dict[str, Value], better: int) -> str:
    name = given.criterion
    two = len(criteria) == 2
    if any(isinstance(value, sympy.Expr) for value in criteria.values()):
        numbers = (f"{name}({model}) {_decimals(value)}" for model, value in criteria.items())
        work.say(lambda: f"In numbers, {joined([*numbers])}.")
    models = list(criteria)
    best = reduce(lambda one, other: other if order(criteria[other], criteria[one]) == better else one, models)
    if any(order(criteria[best], criteria[other]) == 0 for other in models if other != best):
        raise NoSolution(f"{'both' if two else 'the best'} models have the same {name}")
    work.say(f"The {name} of {best} is the {'smaller' if two else 'smallest'} one: {best} is preferred.")
    return ascii_uppercase[models.index(best)]


@slip("largest-wins", "The smallest criterion wins: it is large where the fit is poor or there are many parameters.")
def largest_wins(given: Given, work: Work) -> None:
    """The model with the larger BIC."""
    _compare(given, work, better=1)


@slip(
    "two-forgotten",
    "The BIC has −2 ln p in it: what the richer model gains is twice the difference of the log-likelihoods.",
    when=lambda given: bool(given.border),
)
def two_forgotten(given: Given, work: Work) -> None:
    """The number of data without the 2 before the logarithm."""
    _compare(given, work, better=-1, border=lambda ratio, more: simplest(ratio ** sympy.Rational(1, more)))


@slip(
    "logarithm-of-the-number",
    "That is ln n; the number of data n is e to the power of it.",
    when=lambda given: bool(given.border),
)
def logarithm_kept(given: Given, work: Work) -> None:
    """The logarithm of the number of data."""
    _compare(given, work, better=-1, border=lambda ratio, more: tidy(2 * sympy.log(ratio) / more))


@slip(
    "parameters-exchanged",
    "Each model pays for its own parameters: their numbers were exchanged.",
    when=lambda given: given.fitted is not None and len(given.fitted) == 2 and not given.border,
)
def exchanged(given: Given, work: Work) -> None:
    """The number of parameters of the other model for that of a model."""
    assert given.fitted is not None
    others = reversed(given.fitted.values())
    fitted = {
        name: model.model_copy(update={"k": other.k})
        for (name, model), other in zip(given.fitted.items(), others, strict=True)
    }
    solve(given.model_copy(update={"fitted": fitted}), work)


MISCONCEPTIONS = (
    BIC_SIGN,
    BIC_WITHOUT_LOG,
    largest_wins,
    BIC_LOG_10,
    AIC_FOR_BIC.where_it_shows(),
    BIC_FOR_AIC.where_it_shows(),
    exchanged.where_it_shows(),
    two_forgotten.where_it_shows(),
    logarithm_kept.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Every θ of a fine grid tried, then its neighbourhood; products of chances rather than sums of logs."""
    if given.border and given.fitted is not None:
        chances = {name: at(needed(model.likelihood)) for name, model in given.fitted.items()}
        simple, rich = sorted(given.fitted, key=lambda name: given.fitted[name].k)  # type: ignore[index]
        low, high = 1.0, 1e12  # where the simple model becomes the better one
        for _ in range(200):
            middle = (low * high) ** 0.5
            costs = [given.fitted[name].k * np.log(middle) - 2 * np.log(chances[name]) for name in (simple, rich)]
            low, high = (low, middle) if costs[0] < costs[1] else (middle, high)
        return (high, ascii_uppercase[given.names.index(simple if given.border == "more" else rich)])
    if given.fitted is not None:
        fit = np.array(
            [
                np.log(at(model.likelihood)) if model.likelihood is not None else at(needed(model.log_likelihood))
                for model in given.fitted.values()
            ]
        )
        free = [model.k for model in given.fitted.values()]
        n = given.n or 0
    else:
        assert given.data is not None
        counts = np.array(list(given.data.tosses.values()), dtype=float)
        pooled = counts.sum(axis=0)
        fits = {
            "fair": pooled.sum() * np.log(0.5),
            "shared": _best(*pooled),
            "own": sum(_best(*pair) for pair in counts),
        }
        fit = np.array([fits[name] for name in given.names])
        free = [{"fair": 0, "shared": 1, "own": len(counts)}[name] for name in given.names]
        n = int(pooled.sum())
    price = np.log(float(n)) if given.criterion == "BIC" else 2.0
    criteria = price * np.array(free) - 2 * fit
    winner = ascii_uppercase[int(criteria.argmin())]
    return (criteria, winner) if given.fitted is not None else (fit, criteria, winner)


def _best(heads: float, tails: float) -> float:
    """The greatest log-likelihood of one coin, on grids that close in on it."""
    low, high = 0.0, 1.0
    for _ in range(12):
        theta = np.linspace(low, high, 101)[1:-1]
        values = heads * np.log(theta) + tails * np.log1p(-theta)
        width, centre = (high - low) / 20, theta[values.argmax()]
        low, high = max(0.0, centre - width), min(1.0, centre + width)
    return float(values.max())
