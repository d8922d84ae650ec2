"""Hypothesis profiles: ``--hypothesis-profile=quick`` reports a failing case at once, without making it smaller."""

from hypothesis import Phase, settings

settings.register_profile("quick", phases=[Phase.explicit, Phase.generate])
