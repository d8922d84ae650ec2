"""What is a letter of dynamics: one letter, perhaps Greek and spelled out, perhaps with a short index."""

import pytest

from rldrill.problems.expressions import letter


@pytest.mark.parametrize(
    ("name", "read"),
    [
        ("x", "x"), ("θ", "θ"), ("theta", "θ"), ("theta_1", "θ_1"), ("ϕ", "φ"), ("m_p", "m_p"), ("m_123", "m_123"),
        ("e_1", "e_1"), ("t_0", "t_0"), ("x1", "x_1"), ("theta2", "θ_2"), ("θ₂", "θ_2"),
    ],
)  # fmt: skip
def test_a_letter(name: str, read: str) -> None:
    assert letter(name) == read


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("e", "'e' is the number e; write another letter"), ("t", "'t' is the time; write another letter"),
        ("height", "'height' is not a letter"), ("", "'' is not a letter"), ("1", "'1' is not a letter"),
        ("1_x", "'1_x' is not a letter"), ("_1", "'_1' is not a letter"), ("m_", "'m_' is not a letter"),
        ("m_1234", "'m_1234' is not a letter"), ("m_+", r"'m_\+' is not a letter"), ("m_1_", "'m_1_' is not a letter"),
        ("m__1", "'m__1' is not a letter"), ("mn_1", "'mn_1' is not a letter"),
        ("x12", "'x12' is not a letter"), ("mn1", "'mn1' is not a letter"),
    ],
)  # fmt: skip
def test_what_is_none(name: str, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        letter(name)
