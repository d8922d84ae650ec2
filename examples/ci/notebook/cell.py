# A cell of a notebook, for nbgrader (between BEGIN and END HIDDEN TESTS) or otter (in a test's cell).
import rldrill

exercise = rldrill.load("td-zero/1/62590")
verdict = exercise.check(answer)  # noqa: F821 (what the student gave above: a number, a text, a list or a table)
assert verdict.accepted, verdict.says
