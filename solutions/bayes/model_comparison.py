"""Evidence by evidence, then Bayes' rule over the models."""

from typing import Any

import sympy
from msgspec.structs import replace

from rldrill.problems.bayes.model_comparison import CoinModel, Given
from rldrill.problems.exact import shown
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact, sign
from rldrill.solutions.formula.nodes.leaves import leaf
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bayes import (
    BEST_FIT,
    BINOMIAL,
    EVIDENCE,
    FIXED_COIN,
    MODEL_COMPARISON,
    MODEL_POSTERIOR,
    POSTERIOR_ODDS,
    PRIORS_FORGOTTEN,
    few_values,
    uniform_evidence,
)
from rldrill.solutions.work import Equality, Note, Work

MISCONCEPTIONS = (
    BEST_FIT,
    BINOMIAL,
    replace(PRIORS_FORGOTTEN.where_it_shows(), when=lambda given: len(given.models) == 2),
)


def solve(given: Given, work: Work) -> None:
    """The evidences; the odds of two models, or the posterior of more; the most probable one."""
    names = tuple(given.models)
    tosses: dict[str, Any] = {"heads": given.heads, "tails": given.tails}
    prior = knowns.values(given.prior)
    evidence = work.answer({name: _evidence(work, name, model, tosses) for name, model in given.models.items()})
    known: dict[str, Any] = {"evidence": evidence, "p": prior, "models": names}
    if len(names) == 2:
        odds = work.step(POSTERIOR_ODDS, first_model=names[0], second_model=names[1], **known)
        if given.odds is not None:
            work.say(f"These odds must be ${shown(given.odds)}$:")
            work.answer(work.equate(given.left_open[0], odds, exact(given.odds)))
            return
        odds = work.answer(odds)
    else:
        joint = {name: evidence[name] * prior[name] for name in names}
        products = [sympy.Mul(leaf(evidence[name]), leaf(prior[name]), evaluate=False) for name in names]
        total = sum(joint.values(), exact(0))
        work.say("The products $p(D_z|M) p(M)$ stand above the line, and their sum stands below it:")
        work.lines.append(
            Equality(
                sympy.Add(*products, evaluate=False), (sympy.Add(*map(leaf, joint.values()), evaluate=False), total)
            )
        )
        work.answer({name: work.step(MODEL_POSTERIOR, M=name, **known) for name in names})
    if len(names) == 2:
        _by_the_odds(work, names, odds)
        return
    work.say("All posteriors have the same number below the line, so what stands above it decides:")
    best = work.step(MODEL_COMPARISON, **known)
    told = f"“{best[0]}” is the most probable model" if len(best) == 1 else "No model is more probable than all others"
    work.say(f"{told}, so the answer is {'yes' if best == names[:1] else 'no'}.")
    work.answer(best == names[:1])


def _by_the_odds(work: Work, names: tuple[str, ...], odds: Value) -> None:
    """Of two models the first is the more probable one where the odds are above 1."""
    side = sign(odds - 1)
    relation, what = {1: ("above", "the more"), -1: ("below", "the less"), 0: ("equal to", "not the more")}[side]
    answer = "yes" if side > 0 else "no"
    work.say(f"The odds are {relation} $1$, so “{names[0]}” is {what} probable model: {answer}.")
    work.answer(side > 0)


def _evidence(work: Work, name: str, model: CoinModel, tosses: dict[str, Any]) -> Any:
    if model.theta is not None:
        return work.step(FIXED_COIN, M=name, share=exact(model.theta), **tosses)
    if model.thetas is not None:
        thetas, priors = ({i: exact(pair[which]) for i, pair in enumerate(model.thetas, 1)} for which in (0, 1))
        work.say(f"In “{name}” there are $m = {len(thetas)}$ values $θ_i$, with the probabilities $p(θ_i)$:")
        return work.step(few_values(), M=name, theta_at=thetas, prior_at=priors, count=len(thetas), **tosses)
    if model.a == model.b == 1:
        uniform = Note(
            "If $θ$ is unknown, the evidence is the mean of the likelihood over the prior; with a uniform prior that "
            "is $∫ θ^{n_1} (1 − θ)^{n_0} dθ$ from $0$ to $1$, an integral that is known:"
        )
        if uniform not in work.lines:
            work.lines.append(uniform)
        return work.step(uniform_evidence(), M=name, **tosses)
    integral = Note(
        "If $θ$ is unknown, the evidence is the mean of the likelihood, $∫ p(D_z|θ) p(θ) dθ$, over the prior "
        '$"Beta"(a, b)$. From $0$ to $1$, '
        "$∫ θ^j (1 − θ)^k dθ = j! k!/(j + k + 1)!$. With $a − 1$ and $b − 1$ for $j$ and $k$ that is what the prior is "
        "divided by; with $a + n_1 − 1$ and $b + n_0 − 1$ it is the integral of likelihood times prior:"
    )
    if integral not in work.lines:
        work.lines.append(integral)
    return work.step(EVIDENCE, M=name, beta_a=model.a, beta_b=model.b, **tosses)


def oracle(given: Given) -> Answers:
    """The integrals over θ by Gauss's quadrature, which is exact for polynomials of this degree."""
    nodes, weights = np.polynomial.legendre.leggauss(given.heads + given.tails + 200)
    theta, weights = (nodes + 1) / 2, weights / 2
    evidence = []
    for model in given.models.values():
        if not model.certain:
            density = theta ** (model.a - 1) * (1 - theta) ** (model.b - 1) * weights
            likelihood = theta**given.heads * (1 - theta) ** given.tails
            evidence.append(float((density / density.sum() * likelihood).sum()))
        else:
            chances = np.array([[at(theta), at(chance)] for theta, chance in model.certain]).T
            evidence.append(float(chances[0] ** given.heads * (1 - chances[0]) ** given.tails @ chances[1]))
    if given.odds is not None:
        # Odds of the priors times the ratio of the evidences are the odds given.
        odds = at(given.odds) * evidence[1] / evidence[0]
        return (evidence, odds / (1 + odds) if given.prior[next(iter(given.models))] == "q" else 1 / (1 + odds))
    joint = np.array(evidence) * [at(given.prior[name]) for name in given.models]
    after = joint[0] / joint[1] if len(joint) == 2 else joint / joint.sum()
    return (evidence, after, bool(joint[0] > joint[1:].max() * (1 + 1e-9)))
