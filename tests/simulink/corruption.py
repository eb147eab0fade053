"""Packages with random damage: ``python -m tests.simulink.corruption 10000`` reads so many of each."""

import resource
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from io import BytesIO
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import perf_counter
from zipfile import ZIP_STORED, ZipFile

from rovercheck.checker.simulink.writer.packages import packed
from tests.simulink.hostile import outcome
from tests.simulink.samples import SAMPLES, package_of

WORDS = [
    b"<", b">", b"&", b'"', b"]]>", b"<!--", b"<!DOCTYPE a>", b"<![CDATA[", b"&#27;", b"&#x9b;", b"-1",
    b"9" * 25, b"1e999", b"<P/>", b"<P Name='SSID'>1</P>", b"<Children>", b"</Children>", b"\x00",
    b'Ref="system_root"', b'<System Ref="system_root"/>', b"\xff\xfe", b"\xf0\x9f\x9a\x80", b"../", b"SUB",
    b"#in:", b"%s{0}\\", b"\r\n",
]  # fmt: skip
Damage = Callable[[Random, bytes], bytes]


def flipped(random: Random, data: bytes) -> bytes:
    """Some bytes are others."""
    out = bytearray(data)
    for _ in range(random.choice([1, 1, 2, 5, 40])):
        out[random.randrange(len(out))] = random.randrange(256)
    return bytes(out)


def cut(random: Random, data: bytes) -> bytes:
    """A piece is missing, or all of the rest."""
    at = random.randrange(len(data))
    return data[:at] + (data[at + random.randrange(1, 200) :] if random.random() < 0.6 else b"")


def spliced(random: Random, data: bytes) -> bytes:
    """A piece is there once more, or in another place, or something else is."""
    at, start = random.randrange(len(data)), random.randrange(len(data))
    piece = data[start : start + random.choice([1, 10, 100, 1000])]
    if random.random() < 0.5:
        piece = random.choice(WORDS)
    return data[:at] + piece + data[at + random.choice([0, 0, 1, len(piece)]) :]


def swapped(random: Random, data: bytes) -> bytes:
    """A line is another one of the same text, or is there many times."""
    lines = data.splitlines(keepends=True)
    at = random.randrange(len(lines))
    lines[at] = random.choice(lines) if random.random() < 0.7 else lines[at] * random.choice([2, 50])
    return b"".join(lines)


DAMAGES: tuple[Damage, ...] = (flipped, cut, spliced, swapped)


def damaged(sample: str, many: int, seed: int, folder: Path) -> Iterator[str]:
    """So many models in a folder, one after another; of each the file that is damaged.

    Half of them are damaged as files, half in the text of their parts, which are packed anew.
    """
    random = Random(f"{sample} {seed}")
    whole = {file.name: file.read_bytes() for file in package_of(sample).parent.iterdir() if is_read(file)}
    for name, data in whole.items():
        (folder / name).write_bytes(data)
    for _ in range(many):
        name = random.choice(list(whole))
        if random.random() < 0.5 or name.endswith(".m"):
            (folder / name).write_bytes(random.choice(DAMAGES)(random, whole[name]))
        else:
            packed(folder / name, _one_damaged(random, whole[name]), ZIP_STORED)
        yield name
        (folder / name).write_bytes(whole[name])


def is_read(file: Path) -> bool:
    """Whether a file of an example is one of Simulink's."""
    return file.suffix in (".slx", ".sldd", ".m")


def _one_damaged(random: Random, whole: bytes) -> Mapping[str, bytes]:
    """The parts of a package with one of them damaged, once or often."""
    with ZipFile(BytesIO(whole)) as package:
        files = {name: package.read(name) for name in package.namelist()}
    name = random.choice([name for name in files if name.endswith(".xml")])
    for _ in range(random.choice([1, 1, 1, 4])):
        files[name] = random.choice(DAMAGES)(random, files[name] or b"<")
    return files


def main(many: int, seed: int) -> None:
    """Read them, and say what became of them."""
    for sample in SAMPLES:
        counts: Counter[str] = Counter()
        slowest = 0.0
        with TemporaryDirectory() as temporary:
            folder = Path(temporary)
            for _ in damaged(sample, many, seed, folder):
                start = perf_counter()
                found = outcome(folder / package_of(sample).name)
                slowest = max(slowest, perf_counter() - start)
                counts["refused" if isinstance(found, str) else "read"] += 1
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10
        told = ", ".join(f"{times} {what}" for what, times in sorted(counts.items()))
        print(f"{sample}: {told}; slowest {slowest:.3f} s; most memory {most} MiB", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)


__all__ = ["damaged"]
