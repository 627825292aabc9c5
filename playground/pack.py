"""What the playground is built of beside its own text: the front end as a zip, the language's words, the examples.

python playground/pack.py FOLDER
"""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT), str(ROOT / "runtime")]

import lark  # noqa: E402

from mindlang.explaining.kinds import words_of  # noqa: E402

EXAMPLES = {
    "Braitenberg's wanderer, by rules": "braitenberg.mind",
    "Sorting red and blue": "sort/sort.mind",
    "A guard's round": "patrol/patrol.mind",
    "A lamp found": "light/light.mind",
    "A ball into a goal": "soccer/soccer.mind",
    "The paper's Collect": "collect/collect.mind",
}
# Of what simulates, draws or serves nothing runs in the browser; `sim.outside` knows the names of environments.
LEFT_OUT = ("mindrun/sim/lanes/", "mindlang/view/page/", "mindlang/torch/", "mindlang/environments/")
LONG_AGO = (1980, 1, 1, 0, 0, 0)  # the same bytes whenever it is made


def files() -> Iterator[tuple[str, Path]]:
    """Where each file stands in the zip, and where here."""
    for package, folder in (
        ("mindlang", ROOT / "mindlang"),
        ("mindrun", ROOT / "runtime" / "mindrun"),
        ("lark", Path(lark.__file__).parent),
        ("mindlang/grammar", ROOT / "grammar"),
    ):
        for path in sorted(folder.rglob("*")):
            place = f"{package}/{path.relative_to(folder).as_posix()}"
            if path.suffix in {".py", ".lark", ".md", ".toml"} and not place.startswith(LEFT_OUT):
                yield place, path
    yield "looking.py", HERE / "looking.py"


def words() -> dict[str, list[str]]:
    """The words of the language by what they are for: those that the site and the editors know."""
    joints = sorted({word for phrase in words_of("Words") for word in phrase.split()})
    chapters = ("Nouns", "Settings", "Verbs", "Units")
    return {chapter.lower(): [*words_of(chapter)] for chapter in chapters} | {"joints": joints}


def main(folder: Path) -> None:
    """Write all of it."""
    folder.mkdir(parents=True, exist_ok=True)
    with ZipFile(folder / "front_end.zip", "w", ZIP_DEFLATED, compresslevel=9) as packed:
        for place, path in files():
            entry = ZipInfo(place, LONG_AGO)
            entry.compress_type = ZIP_DEFLATED
            packed.writestr(entry, path.read_bytes())
    texts = {title: (ROOT / "examples" / name).read_text(encoding="utf-8") for title, name in EXAMPLES.items()}
    (folder / "words.json").write_text(json.dumps(words()))
    (folder / "examples.json").write_text(json.dumps(texts, ensure_ascii=False))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
