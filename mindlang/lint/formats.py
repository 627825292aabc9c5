"""Findings for other programs: SARIF 2.1.0, which code hosts and editors read, and GitHub's workflow commands."""

from collections.abc import Iterable, Iterator
from hashlib import sha256
from importlib.metadata import version
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from mindrun.files.printable import visible

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Span
from mindlang.explaining.article import sections

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def sarif(found: Iterable[Diagnostic]) -> dict[str, Any]:
    """Diagnostics as a SARIF log of one run of mindc; paths are as they were said on the command line."""
    results = [_result(each) for each in found]
    titles = {each.name: each.title for each in sections("rules.md")}
    codes = sorted({result["ruleId"] for result in results})
    described = [{"id": code, "shortDescription": {"text": titles.get(code, code)}} for code in codes]
    driver = {"name": "mindc", "version": version("mindlang"), "rules": described}
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _result(diagnostic: Diagnostic) -> dict[str, Any]:
    text = f"{diagnostic.message} {diagnostic.hint}".strip()
    result: dict[str, Any] = {"ruleId": diagnostic.code, "level": diagnostic.severity, "message": {"text": text}}
    if diagnostic.span:
        line = diagnostic.span.source.line(diagnostic.span.line).strip()
        result["locations"] = [_location(diagnostic.span)]
        result["partialFingerprints"] = {"line/v1": sha256(f"{diagnostic.code} {line}".encode()).hexdigest()}
    if diagnostic.labels:
        result["relatedLocations"] = [
            {"id": number, **_location(label.span), "message": {"text": label.message}}
            for number, label in enumerate(diagnostic.labels)
        ]
    return result


def _location(span: Span) -> dict[str, Any]:
    end = Span(span.source, span.end, span.end)
    region = {"startLine": span.line, "startColumn": span.column, "endLine": end.line, "endColumn": end.column}
    uri = quote(PurePath(span.source.name).as_posix())
    return {"physicalLocation": {"artifactLocation": {"uri": uri}, "region": region}}


def annotations(found: Iterable[Diagnostic]) -> Iterator[str]:
    """A workflow command of GitHub for each diagnostic, with its line end."""
    for each in found:
        place = ""
        if each.span:
            end = Span(each.span.source, each.span.end, each.span.end)
            place = f"file={_property(each.span.source.name)},line={each.span.line},col={each.span.column},"
            place += f"endLine={end.line},endColumn={end.column},"
        text = _data(f"{each.message} {each.hint}".strip())
        yield f"::{each.severity} {place}title={_property(each.code)}::{text}\n"


def _data(text: str) -> str:
    return visible(text).replace("%", "%25")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
