#!/usr/bin/env bash
# Gradescope runs this once, when the autograder is built.
set -euo pipefail
apt-get install -y --quiet python3 python3-venv
python3 -m venv /opt/rldrill
/opt/rldrill/bin/pip install --quiet "rldrill==0.1.0"
