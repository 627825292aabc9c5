"""What a proof says, in words and as JSON: `said/NAME.txt` and `said/NAME.json` of every sample.

After a change of words: UPDATE=1 pytest tests/proofs/test_said.py, and read the difference.
"""

import json
import os
from pathlib import Path

import pytest

from mindlang.cli._terminal import console
from mindlang.proofs.proof import Proof, prove
from mindlang.proofs.report import proof_data, proof_report
from tests.hierarchies import doubling
from tests.minds import always, mind
from tests.proofs.samples import SAMPLES, Sample

SAID = Path(__file__).parent / "said"
SHORT = [name for name in SAMPLES if name != "countless"]  # whose paths alone are long


def proved(sample: Sample) -> Proof:
    """What is known of a sample."""
    return prove(sample.graph, sample.weights, sample.delta)


def is_said(text: str, path: Path) -> None:
    """Hold a text against what it was."""
    if os.environ.get("UPDATE"):
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


def printed(sample: Sample, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """The lines that are printed."""
    console().print(proof_report(proof_data(proved(sample), sample.hashes, sample.run)))
    return capsys.readouterr().out.splitlines()


@pytest.mark.parametrize("name", SAMPLES)
def test_in_words(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    sample = SAMPLES[name]
    is_said("".join(f"{line.rstrip()}\n" for line in printed(sample, capsys)), SAID / f"{name}.txt")


@pytest.mark.parametrize("name", SHORT)
def test_as_json(name: str) -> None:
    sample = SAMPLES[name]
    data = proof_data(proved(sample), sample.hashes, sample.run)
    is_said(json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n", SAID / f"{name}.json")


@pytest.mark.parametrize("levels", [127, 128])
def test_more_influence_than_a_number_holds_is_none_in_json(levels: int) -> None:
    """2^128 and more; it does not count as influence for certain."""
    data = proof_data(proved(Sample(mind(*doubling(levels, (always("actuator", 0, 0.25),))))), {}, None)
    assert json.dumps(data, allow_nan=False)
    found = data["actuators"][0]
    assert found["neutral"]["influence"] == ([2.0**127, 2.0**127] if levels == 127 else [0, None])
    assert len(found["paths"]["first"]) == 10


def test_a_table_is_no_wider_than_its_words(capsys: pytest.CaptureFixture[str]) -> None:
    lines = printed(SAMPLES["long"], capsys)
    assert max(map(len, lines)) == max(len(line.rstrip()) for line in lines)
