"""Section 7 of the sheet: linear methods."""

from collections.abc import Callable
from enum import Enum
from functools import cache
from math import factorial
from typing import Any, NamedTuple

from msgspec.structs import replace
from sympy import Add, Expr, Mul, Pow, Rational, S, evaluate, exp, sqrt

from rldrill.problems.linear_quadratic import Notation
from rldrill.problems.mathematics import (
    Accent,
    Fence,
    Fraction,
    Glyph,
    Math,
    Script,
    listed,
    mathematics,
    punctuation,
    row,
    variable,
)
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.formula.notation import (
    Blocks,
    Counting,
    Quantity,
    SumOver,
    T,
    Transposed,
    gamma,
    i,
    letter,
    quantity,
    subscripted,
    t,
)


def _matrix(code: str, head: str) -> type[Quantity]:
    return quantity(code, subscripted(head), matrix=True)


def _reward_layout(time: Math) -> Math:
    return row(variable("r"), Fence(listed((Script(variable("s"), time), Script(variable("a"), time)))))


At = _matrix("At", "A")
Bt = _matrix("Bt", "B")
Pt = _matrix("Pt", "P")
Qt = _matrix("Qt", "Q")
Rt = _matrix("Rt", "R")
Lt = _matrix("Lt", "L")
St = _matrix("St", "s")
Ut = _matrix("Ut", "a")
Nt = _matrix("Nt", "N")
Gt = _matrix("Gt", "G")
Ht = _matrix("Ht", "H")
rt = quantity("rt", _reward_layout)
last_reward = quantity("lastReward", lambda time: row(variable("r"), Fence(Script(variable("s"), time))))
J = letter("J")


def in_costs(states: int) -> str:
    """How a working in values of P reads for somebody who learnt it in costs."""
    return (
        f"$P_t$ is the {'coefficient' if states == 1 else 'matrix'} of the value; in the cost-to-go convention it is "
        "$S_t = −P_t$, and the gain is $L_t = (R_t + B_t^⊤ S_{t+1} B_t)^{−1} B_t^⊤ S_{t+1} A_t$."
    )


with evaluate(False):
    ACTION_FIRST = Misconception(
        "action-before-dynamics",
        "A acts on the state alone: the next state is A s + B a, not A (s + B a).",
        when=lambda given: any(_unit(len(A)) != A for A in given.A),
    )
    DYNAMICS = Formula(
        "dynamics",
        St(t + 1),
        At(t) * St(t) + Bt(t) * Ut(t),
        title="Linear dynamics",
        source="Bertsekas 2017, section 3.1",
        hint="A acts on the state and B on the action; add the two.",
        misread={
            ACTION_FIRST: At(t) * (St(t) + Bt(t) * Ut(t)),
        },
    )
    COST_FOR_REWARD = Misconception("cost-for-reward", "A reward is the cost with a minus sign: −(sᵀQs + aᵀRa).")
    REWARD_WITHOUT_R = Misconception("forgot-r", "The action has its price too: aᵀRa belongs in the bracket.")
    ACTION_NOT_SQUARED = Misconception(
        "action-not-squared",
        "The price of the action is Ra²: the action is squared, as the state is.",
        when=lambda given: len(given.R[0]) == 1,
    )
    WEIGHTS_SQUARED = Misconception(
        "weights-squared", "The weights are not squared: the price is sᵀQs + aᵀRa, not the squares of Qs and Ra."
    )
    LQR_REWARD = Formula(
        "lqr-reward",
        rt(t),
        -(Transposed(St(t)) * Qt(t) * St(t) + Transposed(Ut(t)) * Rt(t) * Ut(t)),
        title="LQR reward",
        source="Bertsekas 2017, section 3.1, with the sign of a reward",
        hint="Work out the price of the state and that of the action, add them, and change the sign.",
        misread={
            COST_FOR_REWARD: Transposed(St(t)) * Qt(t) * St(t) + Transposed(Ut(t)) * Rt(t) * Ut(t),
            REWARD_WITHOUT_R: -Transposed(St(t)) * Qt(t) * St(t),
            ACTION_NOT_SQUARED: -(Transposed(St(t)) * Qt(t) * St(t) + Rt(t) * Ut(t)),
            WEIGHTS_SQUARED: -(Transposed(Qt(t) * St(t)) * Qt(t) * St(t) + Transposed(Rt(t) * Ut(t)) * Rt(t) * Ut(t)),
        },
    )
    LQR_TOTAL = Formula(
        "lqr-total",
        J,
        SumOver(rt(t), t, Counting(0, T)),
        title="Total reward of a rollout",
        source="Bertsekas 2017, section 3.1, with the sign of a reward",
        hint="Add the rewards of all times, those of the first and the last time included.",
    )
    ACTION_SIGN = Misconception("sign-of-feedback", "The action is minus the gain times the state.")
    LQR_ACTION = Formula(
        "lqr-action",
        Ut(t),
        -Lt(t) * St(t),
        title="Linear state feedback",
        source="Bertsekas 2017, section 3.1",
        hint="Multiply the gain by the state, and change the sign.",
        misread={
            ACTION_SIGN: Lt(t) * St(t),
        },
    )
    POSITIVE_S = Misconception(
        "cost-to-go-for-value",
        "P is that of the value sᵀPs, which is never positive; what belongs in (R + BᵀSB)⁻¹BᵀSA is S = −P.",
    )
    FORGOT_R = Misconception("forgot-r", "The price R of the action belongs in the bracket: BᵀPB − R.")
    TRANSPOSED_A = Misconception(
        "transposed-a", "A stands untransposed at the end; only B is transposed.", when=lambda given: len(given.A) > 1
    )
    LQR_GAIN = Formula(
        "lqr-gain",
        Lt(t),
        Pow(Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t), -1) * Transposed(Bt(t)) * Pt(t + 1) * At(t),
        title="LQR gain",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Work out Bᵀ P first; it stands in the bracket and behind it.",
        note="$P$ is the matrix of the value $V(s) = s^⊤ P s$, negative semidefinite. Cost-to-go: $S = −P$.",
        misread={
            POSITIVE_S: -Pow(-Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t), -1)
            * Transposed(Bt(t))
            * Pt(t + 1)
            * At(t),
            FORGOT_R: Pow(Transposed(Bt(t)) * Pt(t + 1) * Bt(t), -1) * Transposed(Bt(t)) * Pt(t + 1) * At(t),
            TRANSPOSED_A: Pow(Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t), -1)
            * Transposed(Bt(t))
            * Pt(t + 1)
            * Transposed(At(t)),
        },
    )
    LQR_BRACKET = Formula(
        "lqr-gain-bracket",
        Ht(t),
        Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t),
        title="LQR gain: the matrix that is inverted",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Work out Bᵀ P first.",
        place=Place.WORKING,
    )
    LQR_PRODUCT = Formula(
        "lqr-gain-product",
        Gt(t),
        Transposed(Bt(t)) * Pt(t + 1) * At(t),
        title="LQR gain: the matrix behind the inverse",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Work out Bᵀ P first.",
        place=Place.WORKING,
    )
    LQR_SOLVED = Formula(
        "lqr-gain-solved",
        Lt(t),
        Pow(Ht(t), -1) * Gt(t),
        title="LQR gain by these two matrices",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Multiply by the inverse from the left.",
        place=Place.WORKING,
    )
    NO_TERMINAL = Misconception(
        "no-terminal-value", "The state at the last time T is rewarded too: there P is −Q, not 0."
    )
    # The same two in the letters of costs.
    FORGOT_R_IN_COSTS = Misconception(
        "forgot-r-in-costs", "The price R of the action belongs in the bracket: it is added to the product with B."
    )
    NO_TERMINAL_COST = Misconception(
        "no-terminal-cost", "The state at the last time T costs something, too: the matrix there is Q_T, not 0."
    )
    LQR_TERMINAL = Formula(
        "lqr-terminal",
        Pt(T),
        -Qt(T),
        title="Value matrix at the end",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="At the last time no action is worth its price, so the value is the reward of the state alone.",
        misread={
            NO_TERMINAL: Mul(0, Qt(T)),
        },
    )
    LOOP_WITHOUT_R = Misconception(
        "closed-loop-without-action-price",
        "The action that the gain takes has its price, too: with A − BL the term −LᵀRL belongs to P.",
    )
    LOOP_WITHOUT_R_IN_COSTS = Misconception(
        "closed-loop-without-action-cost",
        "The action that the gain takes has its price, too: in the form with the closed loop it is added to Q.",
    )
    NEXT_NOT_DISCOUNTED = Misconception(
        "next-not-discounted",
        "What comes after this step is discounted: γ stands wherever the next value does.",
        when=lambda given: given.gamma != 1,
    )
    CROSS_TERM_FORGOTTEN = Misconception(
        "cross-term-forgotten", "N couples state and action: it belongs to the gain, and so to the value."
    )
    LQR_RICCATI = Formula(
        "lqr-riccati",
        Pt(t),
        -Qt(t) + Transposed(At(t)) * Pt(t + 1) * At(t) - Transposed(At(t)) * Pt(t + 1) * Bt(t) * Lt(t),
        title="Riccati recursion",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Work out Aᵀ P first: it stands in both products.",
        note="Cost-to-go: $S_t = Q_t + A_t^⊤ S_{t+1} A_t − A_t^⊤ S_{t+1} B_t L_t$.",
        misread={
            LOOP_WITHOUT_R: -Qt(t) + Transposed(At(t) - Bt(t) * Lt(t)) * Pt(t + 1) * (At(t) - Bt(t) * Lt(t)),
        },
    )


@cache
def rollout(*, discounted: bool, crossed: bool) -> tuple[Formula, Formula]:
    """Reward and total where the last state alone is rewarded, perhaps with a discount or a cross term."""
    state, action = St(t), Ut(t)
    with evaluate(False):
        both = (2 * Transposed(state) * Nt(t) * action,) if crossed else ()
        cost = Add(Transposed(state) * Qt(t) * state, *both, Transposed(action) * Rt(t) * action)
        unsquared = {ACTION_NOT_SQUARED: -Add(Transposed(state) * Qt(t) * state, *both, Rt(t) * action)}
        return (
            replace(LQR_REWARD, right=-cost, misread=unsquared),
            replace(
                LQR_TOTAL,
                right=SumOver(gamma**t * rt(t), t, Counting(0, T - 1)) + gamma**T * last_reward(T)
                if discounted
                else SumOver(rt(t), t, Counting(0, T - 1)) + last_reward(T),
                hint="Add the rewards of all times before the last, and that of the last state.",
            ),
        )


@cache
def at_the_end() -> Formula:
    """The reward of the last state alone."""
    with evaluate(False):
        return replace(LQR_REWARD, left=last_reward(T), right=-(Transposed(St(T)) * Qt(T) * St(T)), misread={})


class Quadratic(NamedTuple):
    """The formulas of LQR in the letters of one convention, with all that the costs of a problem have."""

    terminal: Formula
    gain: Formula
    riccati: Formula
    action: Formula
    #: The matrix that is inverted for the gain, the one behind it, and the gain by these two.
    bracket: Formula
    product: Formula
    solved: Formula


@cache
def quadratic(notation: Notation, *, discounted: bool, crossed: bool) -> Quadratic:
    """LQR as it is written in a convention; the sheet's own formulas, where nothing is added to them."""
    state, action, gain, value = (
        quantity(code, subscripted(head), matrix=True)
        for code, head in zip(("St", "Ut", "Lt", "Pt"), notation[:4], strict=True)
    )
    if not (notation.costs or discounted or crossed):
        return Quadratic(LQR_TERMINAL, LQR_GAIN, LQR_RICCATI, LQR_ACTION, LQR_BRACKET, LQR_PRODUCT, LQR_SOLVED)
    with evaluate(False):
        A, B, Q, R, N, after = At(t), Bt(t), Qt(t), Rt(t), Nt(t), value(t + 1)
        ahead = (gamma,) if discounted else ()
        both = Mul(*ahead, Transposed(B), after, A)
        square = Mul(*ahead, Transposed(B), after, B)
        turned = Mul(*ahead, Transposed(A), after, B)
        bracket = R + square if notation.costs else square - R
        transposed = Mul(*ahead, Transposed(B), after, Transposed(A))
        kept = (Q if notation.costs else -Q) + Mul(*ahead, Transposed(A), after, A)
        gain_alone = {CROSS_TERM_FORGOTTEN: Pow(bracket, -1) * both} if crossed else {}
        value_alone = {CROSS_TERM_FORGOTTEN: kept - turned * gain(t)} if crossed else {}
        product_alone = {CROSS_TERM_FORGOTTEN: both} if crossed else {}
        if crossed:
            both, turned = (both + Transposed(N), turned + N) if notation.costs else (both - Transposed(N), turned - N)
            transposed = transposed + Transposed(N) if notation.costs else transposed - Transposed(N)
        forgot, ended = (FORGOT_R_IN_COSTS, NO_TERMINAL_COST) if notation.costs else (FORGOT_R, NO_TERMINAL)
        loop, price = A - B * gain(t), (LOOP_WITHOUT_R_IN_COSTS if notation.costs else LOOP_WITHOUT_R)
        looped = (Q if notation.costs else -Q) + Mul(*ahead, Transposed(loop), after, loop)
        plain = quadratic(notation, discounted=False, crossed=crossed) if discounted else None
        return Quadratic(
            replace(
                LQR_TERMINAL,
                left=value(T),
                right=Qt(T) if notation.costs else -Qt(T),
                misread={ended: Mul(0, Qt(T))},
            ),
            replace(
                LQR_GAIN,
                left=gain(t),
                right=Pow(bracket, -1) * both,
                misread={forgot: Pow(square, -1) * both, TRANSPOSED_A: Pow(bracket, -1) * transposed}
                | ({NEXT_NOT_DISCOUNTED: plain.gain.right} if plain else {})
                | gain_alone,
            ),
            replace(
                LQR_RICCATI,
                left=value(t),
                right=kept - turned * gain(t),
                misread=({} if crossed else {price: looped})
                | ({NEXT_NOT_DISCOUNTED: plain.riccati.right} if plain else {})
                | value_alone,
            ),
            replace(
                LQR_ACTION,
                left=action(t),
                right=-gain(t) * state(t),
                misread={ACTION_SIGN: gain(t) * state(t)},
            ),
            replace(LQR_BRACKET, right=bracket, misread={NEXT_NOT_DISCOUNTED: plain.bracket.right} if plain else {}),
            replace(
                LQR_PRODUCT,
                right=both,
                misread=({NEXT_NOT_DISCOUNTED: plain.product.right} if plain else {}) | product_alone,
            ),
            replace(LQR_SOLVED, left=gain(t)),
        )


def _unit(size: int) -> tuple[tuple[int, ...], ...]:
    return tuple(tuple(int(row == column) for column in range(size)) for row in range(size))


# The infinite horizon ------------------------------------------------------------------------------
Ai = letter("Ai", "A", matrix=True)
Bi = letter("Bi", "B", matrix=True)
Qi = letter("Qi", "Q", matrix=True)
Ri = letter("Ri", "R", matrix=True)
Pi = letter("Pi", "P", matrix=True)
Li = letter("Li", "L", matrix=True)
Ni = letter("Ni", "N", matrix=True)
modes = letter("modes", "T", matrix=True)
Pm = letter("Pm", Accent(variable("P"), "hat"), matrix=True)
closed = letter("closed", Script(variable("A"), variable("L")), matrix=True)
a1, b1, q1, r1 = (letter(code, glyph) for code, glyph in (("Ak", "A"), ("Bk", "B"), ("Qk", "Q"), ("Rk", "R")))
n1 = letter("Nk", "N")
p1, l1, beta = letter("Pk", "P"), letter("Lk", "L"), letter("betak", "β")

with evaluate(False):
    LQR_STATIONARY = Formula(
        "lqr-stationary",
        Pi,
        -Qi + Transposed(Ai) * Pi * Ai - Transposed(Ai) * Pi * Bi * Li,
        title="Riccati equation, infinite horizon",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Put the same P on both sides of the recursion.",
        note="Of its solutions $P$, the value's is the one that makes $A − B L$ stable.",
        place=Place.BEYOND,
    )
    LQR_BETA = Formula(
        "lqr-quadratic",
        beta,
        b1**2 * q1 + (a1**2 - 1) * r1,
        title="Scalar Riccati equation",
        source="Bertsekas 2017, section 3.1, cleared of its denominator",
        hint="Multiply the Riccati equation by B²P − R; the cubic terms cancel.",
        note="It is then $B^2 P^2 + β P − Q R = 0$.",
        place=Place.BEYOND,
    )
    OTHER_ROOT = Misconception(
        "other-root", "The value sᵀPs is never positive, so P is the negative root, which makes A − BL stable."
    )
    LQR_ROOT = Formula(
        "lqr-infinite",
        p1,
        -(beta + sqrt(beta**2 + 4 * b1**2 * q1 * r1)) / (2 * b1**2),
        title="Scalar LQR, infinite horizon",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="The roots have opposite signs; the value of a state is never positive.",
        note="$S = −P$ is the positive root of $B^2 S^2 − β S − Q R = 0$.",
        place=Place.BEYOND,
        misread={
            OTHER_ROOT: -(beta - sqrt(beta**2 + 4 * b1**2 * q1 * r1)) / (2 * b1**2),
        },
    )
    LQR_MODES = Formula(
        "lqr-modes",
        Pi,
        Rational(1, 2) * modes * Pm * modes,
        title="LQR of two states that fall apart into sum and difference",
        source="Golub & Van Loan 2013, section 7.1: similarity, with T² = 2 I",
        hint="Solve one scalar problem for each mode, and transform back.",
        place=Place.WORKING,
    )
    LQR_STATIONARY_GAIN = Formula(
        "lqr-stationary-gain",
        Li,
        Pow(Transposed(Bi) * Pi * Bi - Ri, -1) * Transposed(Bi) * Pi * Ai,
        title="LQR gain, infinite horizon",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="The gain of a step, with the same P before and after it.",
        place=Place.WORKING,
        misread={
            POSITIVE_S: -Pow(-Transposed(Bi) * Pi * Bi - Ri, -1) * Transposed(Bi) * Pi * Ai,
        },
    )
    LOOP_WITH_PLUS = Misconception(
        "closed-loop-with-plus",
        "The action is minus the gain times the state, so the closed loop is A minus B times it.",
    )
    LQR_CLOSED_LOOP = Formula(
        "lqr-closed-loop",
        closed,
        Ai - Bi * Li,
        title="Closed loop",
        source="Bertsekas 2017, section 3.1",
        hint="Put a = −L s into the dynamics.",
        place=Place.WORKING,
        misread={
            LOOP_WITH_PLUS: Ai + Bi * Li,
        },
    )


@cache
def back_from_modes(head: str) -> Formula:
    """A matrix of the states from that of the modes."""
    if head == "P":
        return LQR_MODES
    with evaluate(False):
        of_modes = letter(f"{head}m", Accent(variable(head), "hat"), matrix=True)
        right = Rational(1, 2) * modes * of_modes * modes
    return replace(LQR_MODES, left=letter(f"{head}i", head, matrix=True), right=right)


class Letters(NamedTuple):
    """The numbers of a scalar system, or of mode i: dynamics and costs, what is found, β, and the closed loop."""

    A: Expr
    B: Expr
    Q: Expr
    R: Expr
    N: Expr
    value: Expr
    gain: Expr
    beta: Expr
    loop: Expr

    def known(self, mode: int, **numbers: Any) -> dict[str, Any]:
        """Numbers as the formulas take them, by the names of the fields."""
        letters = {name: getattr(self, name) for name in numbers}
        if not mode:
            return {letters[name].name: number for name, number in numbers.items()}
        return {"i": mode} | {letters[name].code: {mode: number} for name, number in numbers.items()}


class Modes(Enum):
    """The modes of a system: none, since it is scalar; entries of the state, A₁; sum and difference, Â₁."""

    NONE = 0
    ENTRIES = 1
    SUM_AND_DIFFERENCE = 2


@cache
def _letters_of(notation: Notation, modes: Modes) -> Letters:
    if modes is Modes.NONE:
        value, gain = (letter(f"{glyph}k", glyph) for glyph in (notation.value, notation.gain))
        return Letters(a1, b1, q1, r1, n1, value, gain, beta, closed)

    def head(glyph: str) -> Math:
        hat = modes is Modes.SUM_AND_DIFFERENCE and glyph != "β"
        return Accent(variable(glyph), "hat") if hat else variable(glyph)

    def numbered(glyph: str) -> Expr:
        return quantity(f"{glyph}{modes.name}", subscripted(head(glyph)))(i)

    def looped(index: Math) -> Math:
        return Script(head("A"), row(variable(notation.gain), punctuation(","), index))

    loop = quantity(f"loop{notation.gain}{modes.name}", looped)(i)
    glyphs = ("A", "B", "Q", "R", "N", notation.value, notation.gain, "β")
    return Letters(*[*map(numbered, glyphs), loop])


class ScalarSystem(NamedTuple):
    """The formulas of the infinite horizon of a scalar system, or of one mode."""

    letters: Letters
    #: The Riccati equation with the gain put in, in which only P is left.
    equation: Formula
    #: The same without its denominator, multiplied out, and collected: both sides of every line.
    cleared: tuple[tuple[Expr, Expr], ...]
    beta: Formula
    #: What is 0 for P, with β.
    quadratic: Expr
    root: Formula
    gain: Formula
    closed_loop: Formula


@cache
def scalar_system(notation: Notation, *, discounted: bool, crossed: bool, modes: Modes = Modes.NONE) -> ScalarSystem:
    """The scalar problem in the letters of one convention, or in those of a mode."""
    letters = _letters_of(notation, modes)
    A, B, Q, R, N, P, L, b, loop = letters
    plain, costs = not (notation.costs or discounted or crossed), notation.costs
    own = plain and modes is Modes.NONE
    with evaluate(False):
        ahead = (gamma,) if discounted else ()
        twice = (gamma**2,) if discounted else ()
        price, both = Mul(*ahead, B**2, P), Mul(*ahead, B, P, A)
        turned = (both + N if costs else both - N) if crossed else both
        bracket, cost = (R + price, Q) if costs else (price - R, -Q)
        kept = Mul(*ahead, A**2, P)
        square, curved = Mul(*ahead, B**2, P**2), Mul(*twice, A**2, B**2, P**2)
        bought, paid = Mul(*ahead, B**2, Q, P), Mul(*ahead, A**2, R, P)
        beta_right = Mul(*ahead, B**2, Q) + (Mul(*ahead, A**2) - 1) * R
        product = Q * R
        mixed: tuple[Expr, ...] = ()
        if crossed:
            cross = Mul(2, *ahead, A, B, N)
            mixed = (-Mul(cross, P) if costs else Mul(cross, P), -(N**2))
            beta_right = beta_right - cross
            product = product - N**2
        multiplied = (
            (Add(R * P, square), Add(Q * R, bought, paid, curved, -curved, *mixed))
            if costs
            else (square - R * P, Add(-bought, Q * R, curved, -paid, -curved, *mixed))
        )
        quadratic = Add(square, -b * P if costs else b * P, -product)
        root = b + sqrt(b**2 + Mul(4, *ahead, B**2, product))
        near = scalar_system(notation, discounted=False, crossed=crossed, modes=modes) if discounted else None
        uncrossed = scalar_system(notation, discounted=discounted, crossed=False, modes=modes) if crossed else None
        misread = {OTHER_ROOT: -(b - sqrt(b**2 + 4 * B**2 * Q * R)) / (2 * B**2)} if plain else {}
        if near:
            misread[NEXT_NOT_DISCOUNTED] = near.root.right
        if uncrossed:
            misread[CROSS_TERM_FORGOTTEN] = uncrossed.root.right
        best = Mul(turned, Pow(bracket, -1))
        cost_to_go = {POSITIVE_S: Mul(-1, B, P, A, Pow(-(B**2) * P - R, -1))} if plain else {}
        return ScalarSystem(
            letters,
            replace(LQR_STATIONARY, left=P, right=cost + kept - Mul(turned**2, Pow(bracket, -1)), note=""),
            (
                (P * bracket, (cost + kept) * bracket - turned**2),
                multiplied,
                (Add(square, Mul(-1, beta_right, P) if costs else Mul(beta_right, P), -product), S.Zero),
            ),
            LQR_BETA
            if own
            else replace(
                LQR_BETA,
                left=b,
                right=beta_right,
                note="",
                misread=({NEXT_NOT_DISCOUNTED: near.beta.right} if near else {})
                | ({CROSS_TERM_FORGOTTEN: uncrossed.beta.right} if uncrossed else {}),
            ),
            quadratic,
            LQR_ROOT
            if own
            else replace(
                LQR_ROOT,
                left=P,
                right=(root if costs else -root) / Mul(2, *ahead, B**2),
                misread=misread,
                note="",
            ),
            replace(
                LQR_STATIONARY_GAIN,
                left=L,
                right=best,
                misread=cost_to_go | ({CROSS_TERM_FORGOTTEN: uncrossed.gain.right} if uncrossed else {}),
            ),
            replace(LQR_CLOSED_LOOP, left=loop, right=A - B * L, misread={}),
        )


class Stationary(NamedTuple):
    """The formulas of the infinite horizon in the letters of one convention."""

    equation: Formula
    gain: Formula
    closed_loop: Formula


@cache
def stationary(notation: Notation, *, discounted: bool, crossed: bool) -> Stationary:
    """The infinite horizon as it is written in a convention; the sheet's own formulas, where nothing is added."""
    if not (notation.costs or discounted or crossed):
        return Stationary(LQR_STATIONARY, LQR_STATIONARY_GAIN, LQR_CLOSED_LOOP)
    value, gain = letter(f"{notation.value}i", notation.value, matrix=True), letter(f"{notation.gain}i", notation.gain,
                                                                                    matrix=True)  # fmt: skip
    loop = letter(f"closed{notation.gain}", Script(variable("A"), variable(notation.gain)), matrix=True)
    with evaluate(False):
        ahead = (gamma,) if discounted else ()
        plain = stationary(notation, discounted=False, crossed=crossed) if discounted else None
        turned = Mul(*ahead, Transposed(Ai), value, Bi)
        square, both = Mul(*ahead, Transposed(Bi), value, Bi), Mul(*ahead, Transposed(Bi), value, Ai)
        bracket = Ri + square if notation.costs else square - Ri
        uncrossed = {CROSS_TERM_FORGOTTEN: Pow(bracket, -1) * both} if crossed else {}
        if crossed:
            turned = turned + (Ni if notation.costs else -Ni)
            both = both + Transposed(Ni) if notation.costs else both - Transposed(Ni)
        return Stationary(
            replace(
                LQR_STATIONARY,
                left=value,
                right=(Qi if notation.costs else -Qi) + Mul(*ahead, Transposed(Ai), value, Ai) - turned * gain,
                note="",
            ),
            replace(
                LQR_STATIONARY_GAIN,
                left=gain,
                right=Pow(bracket, -1) * both,
                misread=({NEXT_NOT_DISCOUNTED: plain.gain.right} if plain else {}) | uncrossed,
            ),
            replace(LQR_CLOSED_LOOP, left=loop, right=Ai - Bi * gain, misread={LOOP_WITH_PLUS: Ai + Bi * gain}),
        )


@cache
def of_a_mode(name: str) -> tuple[Expr, Expr]:
    """What a matrix makes of the columns of T: A T, and T Â."""
    hat = letter(f"{name}m", Accent(variable(name), "hat"), matrix=True)
    with evaluate(False):
        return letter(f"{name}i", name, matrix=True) * modes, modes * hat


# Linearisation --------------------------------------------------------------------------------------
def _letter(name: Math) -> Math:
    """The name of a state or action as its letter: θ₁ for ``θ_1``."""
    return mathematics(name.text) if isinstance(name, Glyph) else name


def _over_letter(above: Math, below: Math) -> Math:
    return Fraction(row(variable("∂"), above), row(variable("∂"), _letter(below)))


def _by_entry(by: str) -> Callable[..., Math]:
    """Written ∂f₂/∂s₁ at the operating point."""
    return lambda line, column: row(_over_letter(Script(variable("f"), line), Script(variable(by), column)), _POINT)


def _bar(head: str) -> Math:
    return Accent(variable(head), "bar")


def _gradient(by: str) -> Math:
    return row(Script(variable("∇"), variable(by)), variable("f"), _POINT)


def _entry(head: str) -> Callable[..., Math]:
    return lambda line, column: Script(variable(head), row(line, column))


_POINT = Fence(listed((_bar("s"), _bar("a"))))
j = letter("j")
#: ∂f₂/∂θ, and ∂D/∂θ of a named part of the dynamics.
partial = quantity("partial", lambda line, name: _over_letter(Script(variable("f"), line), name))
partial_part = quantity("partialPart", lambda part, name: _over_letter(_letter(part), name))
part_value = quantity("partValue", _letter)
partial_s, partial_a = quantity("partialS", _by_entry("s")), quantity("partialA", _by_entry("a"))
Aij, Bij = quantity("Aij", _entry("A")), quantity("Bij", _entry("B"))
f_value, f_point = (quantity(code, lambda component: row(Script(variable("f"), component), _POINT))
                    for code in ("fValue", "fPoint"))  # fmt: skip
f_alone = quantity("fAlone", lambda _: row(variable("f"), _POINT))  # where f has one component only
f_at = letter("fat", row(variable("f"), Fence(listed((variable("s"), variable("a"))))), matrix=True)
f_bar = letter("fbar", row(variable("f"), _POINT), matrix=True)
F_bar = letter("Fbar", row(variable("F"), _POINT), matrix=True)
F_at = letter("Fat", row(variable("F"), Fence(listed((variable("s"), variable("a"))))), matrix=True)
grad_s, grad_a = letter("gradS", _gradient("s"), matrix=True), letter("gradA", _gradient("a"), matrix=True)
sv, av = letter("sv", "s", matrix=True), letter("av", "a", matrix=True)
s_bar, a_bar = letter("sbar", _bar("s"), matrix=True), letter("abar", _bar("a"), matrix=True)
Cc = letter("Cc", "C", matrix=True)
A_tilde = letter("Atilde", Accent(variable("A"), "tilde"), matrix=True)
B_tilde = letter("Btilde", Accent(variable("B"), "tilde"), matrix=True)
dt = letter("dt", row(variable("Δ"), variable("t")))
unit = letter("unit", "I", matrix=True)
delta_s, delta_a, delta_f, delta_next = (
    letter(code, row(variable("δ"), variable(glyph)), matrix=True)
    for code, glyph in (("ds", "s"), ("da", "a"), ("df", "f"), ("dF", "F"))
)
s1_bar, f1_bar = letter("sbark", _bar("s")), letter("fbark", row(variable("f"), _POINT))
Ad, Bd = (letter(f"{head}d", Script(variable(head), variable("Δ")), matrix=True) for head in "AB")

with evaluate(False):
    LINEARISE = Formula(
        "linearise",
        f_at,
        f_bar + grad_s * (sv - s_bar) + grad_a * (av - a_bar),
        title="Linearisation at an operating point",
        source="Åström & Murray 2008, section 5.4",
        hint="Differentiate each component of f with respect to each state and action, then put in the numbers.",
        sign="≈",
    )
    DEVIATION = Formula(
        "linearise-deviation",
        delta_f,
        Ai * delta_s + Bi * delta_a,
        title="Linearisation: the change of the rates",
        source="Åström & Murray 2008, section 5.4",
        hint="Multiply A by the deviation of the state and B by that of the action, and add.",
        place=Place.WORKING,
    )
    STATE_JACOBIAN = Formula(
        "linearise-a",
        Aij(i, j),
        partial_s(i, j),
        title="Linearisation: A, in the state",
        source="Åström & Murray 2008, section 5.4",
        hint="Row i belongs to the component of f, column j to the state; differentiate first, then put numbers in.",
    )
    INPUT_JACOBIAN = Formula(
        "linearise-b",
        Bij(i, j),
        partial_a(i, j),
        title="Linearisation: B, in the action",
        source="Åström & Murray 2008, section 5.4",
        hint="Row i belongs to the component of f, column j to the action.",
    )
    FORGOT_IDENTITY = Misconception(
        "forgot-identity",
        "The Euler step adds Δt f to the state, so its derivative with respect to the state is I + Δt A.",
    )
    EULER_A = Formula(
        "linearise-euler-a",
        Ad,
        unit + dt * Ai,
        title="Euler step of A",
        source="LaValle 2006, section 14.3.2",
        hint="Differentiate s + Δt f(s, a) with respect to s: the first term gives the identity.",
        place=Place.BEYOND,
        misread={
            FORGOT_IDENTITY: dt * Ai,
        },
    )
    EULER_B = Formula(
        "linearise-euler-b",
        Bd,
        dt * Bi,
        title="Euler step of B",
        source="LaValle 2006, section 14.3.2",
        hint="Differentiate s + Δt f(s, a) with respect to a: the first term does not depend on a.",
        place=Place.BEYOND,
    )
    PART_VALUE = Formula(
        "linearise-f",
        f_value(i),
        f_point(i),
        title="The dynamics at the operating point",
        source="Åström & Murray 2008, section 5.4",
        hint="Put the operating point into every component of f.",
        place=Place.WORKING,
    )
    EULER_F = Formula(
        "linearise-euler-f",
        F_bar,
        s_bar + dt * f_bar,
        title="Euler step at the operating point",
        source="LaValle 2006, section 14.3.2",
        hint="The state moves by Δt times its rate.",
        place=Place.WORKING,
    )
    C_IS_F = Misconception("c-is-f", "C is what is left at s = 0 and a = 0: what s̄ and ā contribute is subtracted.")
    AFFINE_TERM = Formula(
        "linearise-affine",
        Cc,
        f_bar - Ai * s_bar - Bi * a_bar,
        title="Linearisation: constant C",
        source="Åström & Murray 2008, section 5.4, multiplied out",
        hint="Multiply the linearisation out and collect what contains neither s nor a.",
        misread={
            C_IS_F: f_bar,
        },
    )
    AUGMENTED_A = Formula(
        "linearise-augmented-a",
        A_tilde,
        Blocks(2, Ai, Cc, 0, 1),
        title="C pulled into the state, (s, 1)",
        source="Siciliano et al. 2009, section 2.7: homogeneous coordinates",
        hint="The state gets a last entry that is always 1; C is the column that multiplies it.",
    )
    AUGMENTED_B = Formula(
        "linearise-augmented-b",
        B_tilde,
        Blocks(2, Bi, 0),
        title="B for the state (s, 1)",
        source="Siciliano et al. 2009, section 2.7: homogeneous coordinates",
        hint="The action does not change the last entry, which stays 1.",
    )


class AffineStep(NamedTuple):
    """The affine form of a discretised system: what is multiplied out, its constant, the matrices for (s, 1)."""

    linear: Formula
    constant: Formula
    state: Formula
    action: Formula


@cache
def affine_step() -> AffineStep:
    """The affine form in the letters of a step: F for f, and its derivatives for A and B."""
    with evaluate(False):
        return AffineStep(
            replace(LINEARISE, left=F_at, right=F_bar + Ad * (sv - s_bar) + Bd * (av - a_bar)),
            replace(AFFINE_TERM, right=F_bar - Ad * s_bar - Bd * a_bar, misread={C_IS_F: F_bar}),
            replace(AUGMENTED_A, right=Blocks(2, Ad, Cc, 0, 1)),
            replace(AUGMENTED_B, right=Blocks(2, Bd, 0)),
        )


@cache
def deviation(*, discretised: bool) -> Formula:
    """How the rates, or the next state, change to first order."""
    if not discretised:
        return DEVIATION
    with evaluate(False):
        return replace(DEVIATION, left=delta_next, right=Ad * delta_s + Bd * delta_a)


class Hold(NamedTuple):
    """A zero-order hold: the matrices of a step, and where the operating point goes in it."""

    state: Formula
    action: Formula
    point: Formula


def _held(left: Expr, right: Expr, hint: str) -> Formula:
    source = "Åström & Wittenmark 1997, section 2.3"
    return Formula("zero-order-hold", left, right, "Zero-order hold", source, hint, place=Place.WORKING)


_GROWN = "Without the action the state grows like e to the power A t; write that down, or its series as far as it goes."
_INTEGRAL = "Integrate e to the power A t, or its series, over the step, and multiply by B."
_RATES_HELD = "From the operating point the rates are held: the same integral, times f instead of B."


@cache
def nilpotent_hold(order: int) -> Hold:
    """The hold where so high a power of A vanishes: the series of the exponential ends."""
    with evaluate(False):
        integral = [_term(k, k - 1) for k in range(2, order + 1)]
        moved = Add(s_bar, dt * f_bar, *(term * f_bar for term in integral))
        return Hold(
            _held(Ad, Add(unit, *(_term(k, k) for k in range(1, order))), _GROWN),
            _held(Bd, Add(dt * Bi, *(term * Bi for term in integral)), _INTEGRAL),
            _held(F_bar, moved, _RATES_HELD),
        )


def _term(order: int, power: int) -> Expr:
    """A term of the series of the exponential, or of its integral."""
    return Mul(dt if order == 1 else dt**order / factorial(order), *[Ai] * power)


@cache
def scalar_hold() -> Hold:
    """The hold of a single state whose rate depends on it."""
    with evaluate(False):
        grown = (exp(dt * a1) - 1) / a1
        return Hold(
            _held(Ad, exp(dt * a1), _GROWN),
            _held(Bd, grown * b1, _INTEGRAL),
            _held(F_bar, s1_bar + grown * f1_bar, _RATES_HELD),
        )


# Differential dynamic programming -------------------------------------------------------------------
def _sub(head: str, *below: str) -> Math:
    return Script(variable(head), row(*map(variable, below)))


def _component(*by: str) -> Callable[..., Math]:
    return lambda index: Script(variable("f"), row(index, punctuation(","), *map(variable, by)))


def _letters(head: str, code: str) -> Any:
    """The derivatives of a function by s and a: first s and a, then ss, as, aa."""
    return tuple(
        letter(f"{code}{''.join(by)}", _sub(head, *by), matrix=True)
        for by in (("s",), ("a",), ("s", "s"), ("a", "s"), ("a", "a"))
    )


Q_s, Q_a, Q_ss, Q_as, Q_aa = _letters("Q", "Q_")
r_s, r_a, r_ss, r_as, r_aa = _letters("r", "r_")
f_s, f_a, *_ = _letters("f", "f_")
V_s, _, V_ss, *_ = _letters("V′", "V_")
V_i = quantity("Vi", lambda index: Script(variable("V′"), row(variable("s"), punctuation(","), index)))
f_iss, f_ias, f_iaa = (
    quantity(f"fi{''.join(by)}", _component(*by), matrix=True) for by in (("s", "s"), ("a", "s"), ("a", "a"))
)


def _second(line: Math, first: Math, then: Math) -> Math:
    above = Script(variable("∂"), above=Glyph("2", "number"))
    of = variable(line.text) if isinstance(line, Glyph) and line.text in ("r", "f") else Script(variable("f"), line)
    if first == then:
        below: Math = row(variable("∂"), Script(_letter(first), above=Glyph("2", "number")))
    else:
        below = row(variable("∂"), _letter(first), variable("∂"), _letter(then))
    return Fraction(row(above, of), below)


#: ∂²f₁/∂θ² and the like; of the reward, or of an f of one component, with r or f in place of the number.
second = quantity("secondD", _second)
g = letter("g", "k")
f_ijk = quantity("fijk", lambda line, first, then: Script(variable("f"), row(line, punctuation(","), first, then)))
r_jk = quantity("rjk", lambda first, then: Script(variable("r"), row(first, then)))
second_at = quantity("secondAt", lambda line, *by: row(_second(line, *(Script(variable("ξ"), k) for k in by)), _POINT))
derived_at = quantity(
    "derivedAt",
    lambda of, *by: row(_over_letter(of, *by) if len(by) == 1 else _second(Glyph(of.text, "variable"), *by), _POINT),
)
Components = letter("components", "n")
kd, Kd = letter("kd", "k", matrix=True), letter("Kd", "K", matrix=True)
ZERO_DERIVATIVE = letter("zeroDerivative", Glyph("0", "number"), matrix=True)
_DDP = "Tassa, Erez & Todorov 2012, with rewards for costs"

with evaluate(False):
    OLD_ACTION_FORGOTTEN = Misconception(
        "old-action-forgotten", "k and K(s − s̄) say by how much the action changes: the old action ā is added."
    )
    GAIN_TIMES_STATE = Misconception(
        "gain-times-state", "The gain multiplies how far the state is from the old one, s − s̄, not the state itself."
    )
    DDP = Formula(
        "ddp",
        av,
        a_bar + kd + Kd * (sv - s_bar),
        title="Differential dynamic programming: the new action",
        source=_DDP,
        hint="Change the old action by k, and by K for every deviation from the old state.",
        note="Linearise the dynamics, make the reward quadratic, solve the LQR problem, repeat; "
        "iLQR leaves the second derivatives of $f$ out.",
        misread={
            OLD_ACTION_FORGOTTEN: kd + Kd * (sv - s_bar),
            GAIN_TIMES_STATE: a_bar + kd + Kd * sv,
        },
    )
    SECOND_DERIVATIVE = Formula(
        "ddp-second",
        f_ijk(i, j, g),
        second_at(i, j, g),
        title="Second derivatives, of the reward and for DDP also of the dynamics",
        source=_DDP,
        hint="Differentiate with respect to any two entries of ξ, which holds state and action, in either order.",
        place=Place.WORKING,
    )
    DDP_S = Formula(
        "ddp-q-s",
        Q_s,
        r_s + Transposed(f_s) * V_s,
        title="DDP: gradient of Q in the state",
        source=_DDP,
        hint="The chain rule: the reward's own gradient, and the next value's through f.",
        note="Indices are derivatives; $V′$ is the value of the next state.",
        place=Place.BEYOND,
    )
    DDP_A = Formula(
        "ddp-q-a",
        Q_a,
        r_a + Transposed(f_a) * V_s,
        title="DDP: gradient of Q in the action",
        source=_DDP,
        hint="The chain rule: the reward's own gradient, and the next value's through f.",
        place=Place.BEYOND,
    )
    DDP_SS = Formula(
        "ddp-q-ss",
        Q_ss,
        r_ss + Transposed(f_s) * V_ss * f_s + SumOver(V_i(i) * f_iss(i), i, Components),
        title="DDP: Hessian of Q in the state",
        source=_DDP,
        hint="Differentiate the chain rule once more: f is curved too.",
        note="iLQR leaves the sum out.",
        place=Place.BEYOND,
    )
    DDP_AS = Formula(
        "ddp-q-as",
        Q_as,
        r_as + Transposed(f_a) * V_ss * f_s + SumOver(V_i(i) * f_ias(i), i, Components),
        title="DDP: mixed Hessian of Q",
        source=_DDP,
        hint="One derivative is with respect to the action, one to the state: fₐᵀ stands before, fₛ behind.",
        place=Place.BEYOND,
    )
    DDP_AA = Formula(
        "ddp-q-aa",
        Q_aa,
        r_aa + Transposed(f_a) * V_ss * f_a + SumOver(V_i(i) * f_iaa(i), i, Components),
        title="DDP: Hessian of Q in the action",
        source=_DDP,
        hint="It must be negative (definite), or Q has no maximum.",
        place=Place.BEYOND,
    )
    K_WITH_PLUS = Misconception("uphill-sign", "At the maximum Qₐ + Qₐₐ δa = 0, so k = −Qₐₐ⁻¹ Qₐ: with its minus sign.")
    DDP_GREATEST = Formula(
        "ddp-greatest",
        ZERO_DERIVATIVE,
        Q_a + Q_as * (sv - s_bar) + Q_aa * (av - a_bar),
        title="DDP: where Q is greatest in the action",
        source=_DDP,
        hint="Differentiate the quadratic Q with respect to a.",
        place=Place.WORKING,
    )
    DDP_k = Formula(
        "ddp-k",
        kd,
        -Pow(Q_aa, -1) * Q_a,
        title="DDP: change of the action",
        source=_DDP,
        hint="The maximum of the quadratic Q in a, at the old state.",
        place=Place.BEYOND,
        misread={
            K_WITH_PLUS: Pow(Q_aa, -1) * Q_a,
        },
    )
    DDP_K = Formula(
        "ddp-gain",
        Kd,
        -Pow(Q_aa, -1) * Q_as,
        title="DDP: gain",
        source=_DDP,
        hint="The same inverse as for k, times the mixed Hessian.",
        place=Place.BEYOND,
    )


class Expansion(NamedTuple):
    """The formulas of a backward step: the derivatives of Q, and the change of the action."""

    s: Formula
    a: Formula
    ss: Formula
    mixed: Formula
    aa: Formula
    change: Formula
    gain: Formula


@cache
def expansion(*, scalar: bool, second_order: bool) -> Expansion:
    """The formulas for vectors, or for one state and one action; of these iLQR needs no second derivatives of f."""
    if not scalar:
        return Expansion(DDP_S, DDP_A, DDP_SS, DDP_AS, DDP_AA, DDP_k, DDP_K)
    q_s, q_a, q_ss, q_as, q_aa = _numbers("Q", "Q_")
    first_s, first_a, *seconds = _numbers("r", "r_")
    by_s, by_a, *curved = _numbers("f", "f_")
    slope, _, curve, *_ = _numbers("V′", "V_")
    change, gain = letter("kd", "k"), letter("Kd", "K")
    with evaluate(False):
        products = (curve * by_s**2, curve * by_a * by_s, curve * by_a**2)
        hessians = [
            Add(reward, product, *([slope * bent] if second_order else []))
            for reward, product, bent in zip(seconds, products, curved, strict=True)
        ]
        return Expansion(
            replace(DDP_S, left=q_s, right=first_s + by_s * slope, note=""),
            replace(DDP_A, left=q_a, right=first_a + by_a * slope),
            replace(DDP_SS, left=q_ss, right=hessians[0], note=""),
            replace(DDP_AS, left=q_as, right=hessians[1]),
            replace(DDP_AA, left=q_aa, right=hessians[2]),
            replace(DDP_k, left=change, right=-(q_a / q_aa), misread={K_WITH_PLUS: q_a / q_aa}),
            replace(DDP_K, left=gain, right=-(q_as / q_aa)),
        )


def _numbers(head: str, code: str) -> Any:
    """The derivatives of a function of one state and one action: first s and a, then ss, as, aa."""
    return tuple(letter(f"{code}{by}", _sub(head, *by)) for by in ("s", "a", "ss", "as", "aa"))


@cache
def derivative_of(head: str, by: str) -> Formula:
    """What a derivative of r or f by the single state and action is, the first or the second."""
    with evaluate(False):
        left = quantity(f"{head}{by}At", lambda *_: _sub(head, *by))(i, j, *([g] if len(by) > 1 else []))
        right = derived_at(put_in_name(head), *map(put_in_name, by))
        return replace(STATE_JACOBIAN if len(by) == 1 else SECOND_DERIVATIVE, left=left, right=right)


@cache
def reward_second() -> Formula:
    """Second derivatives of the reward."""
    with evaluate(False):
        return replace(SECOND_DERIVATIVE, left=r_jk(j, g), right=second_at(put_in_name("r"), j, g))


def ilqr(formula: Formula) -> Expr:
    """A Hessian of Q as iLQR has it: without the sum over the second derivatives of the dynamics."""
    return Add(*formula.right.args[:-1], evaluate=False)
