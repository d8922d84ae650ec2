"""One module for every command: a thin function over a library call.

Only typer is imported at the top of these modules, so that help and completion stay fast.
"""
