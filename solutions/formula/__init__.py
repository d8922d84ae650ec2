"""What a formula is: one sympy expression, and its readings.

As it stands it is typeset (``typesetting``); with the givens put in it is a step (``putting_in``);
compiled it is the exact answer (``compiling``); with one term changed it is a mistake (``formula``).
"""
