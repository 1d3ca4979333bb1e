"""Runs deck.yml in this folder by pyKO, whose folder and step reduction are the arguments, and writes result.json. Needs the Python of pyKO."""

from __future__ import annotations

import contextlib
import io
import json
import pickle
import re
import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
# The wrapper has the code's own name: it is not on the path here.
sys.path = [place for place in sys.path if Path(place).resolve() != Path(__file__).resolve().parent]
import pyko  # noqa: E402

log = io.StringIO()
with contextlib.redirect_stdout(log):
    pyko.run(fin="deck.yml", verbose=False, usertstepscale=float(sys.argv[2]))
print(log.getvalue())
ratio = re.search(r"KE\+IE ratio \(final/zeroth\)\):\s*([0-9.eE+-]+)", log.getvalue())
if ratio is None:
    sys.exit("pyKO printed no energy ratio")

times, rear, face = [], [], []
with Path("fields.dat").open("rb") as file:
    while True:
        try:
            fields = pickle.load(file)
        except EOFError:
            break
        bodies = fields.mat.magnitude
        last = max(i for i in range(len(bodies)) if bodies[i] == bodies[0])
        stress = fields.sigmar.magnitude
        times.append(float(fields.time.magnitude[0]))
        rear.append(float(fields.up.magnitude[-1]))
        face.append(-0.5 * float(stress[last] + stress[last + 1]))
result = {
    "time_s": times,
    "rear_velocity_m_s": rear,
    "interface_stress_pa": face,
    "energy_error_percent": 100 * (float(ratio[1]) - 1),
}
Path("result.json").write_text(json.dumps(result))
