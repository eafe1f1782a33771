"""Where compiled kernels are kept, and when they are made again."""

import atexit
import logging
import os
import pickle
import re
import shutil
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any, ClassVar

import numba
from numba.core import caching

log = logging.getLogger("strikewave")
LIBRARY = Path(__file__).resolve().parents[1]
IMPORTED = re.compile(r"^from (\.+)([\w.]*) import (\([^)]*\)|.*)", re.MULTILINE)


@lru_cache
def sources_key() -> str:
    """Twelve letters that change with any source of the library."""
    return _key_of(LIBRARY.rglob("*.py"))


def _key_of(sources: Iterable[Path]) -> str:
    return sha256(b"".join(source.read_bytes() for source in sorted(sources))).hexdigest()[:12]


@lru_cache
def kernels_key(source: Path) -> str:
    """Twelve letters that change with anything that the machine code of this file's kernels may come from.

    Numba looks at the file alone. Kernels also hold what they call from files that are imported, and what is done with
    the tuples they are given: of contact laws, and of files that import theirs.
    """
    laws = LIBRARY.glob("contact/*.py")
    callers = (*(LIBRARY / "numerics").rglob("*.py"), LIBRARY / "stability" / "integrators.py")
    users = (each for each in callers if source in _imports(each))
    return _key_of(_closure(source).union(*map(_closure, (*laws, *users))))


def _closure(source: Path) -> set[Path]:
    found, ahead = set(), [source]
    while ahead:
        each = ahead.pop()
        if each not in found:
            found.add(each)
            ahead += _imports(each)
    return found


@lru_cache
def _imports(source: Path) -> frozenset[Path]:
    """Files of the library that this one imports by name; not what a package collects in its `__init__`."""
    found = set()
    for dots, module, names in IMPORTED.findall(source.read_text(encoding="utf-8")):
        folder = source.parents[len(dots) - 1].joinpath(*module.split("."))
        found |= {folder.with_suffix(".py")} if module else set()
        found |= {folder / f"{name}.py" for name in re.findall(r"\w+", names)}
    return frozenset(each for each in found if each.is_file())


def cache_home() -> Path:
    """Where this user's programs keep what they can make again."""
    return Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")) / "strikewave"


def _cache_folder() -> Path:
    given = os.environ.get("NUMBA_CACHE_DIR")
    return Path(given) if given else cache_home() / ("checked-kernels" if numba.config.BOUNDSCHECK else "kernels")


def _usable(folder: Path) -> Path:
    """The folder if files can be kept in it; else a temporary one with what is in it; else it as it is, to read."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as trial:
            trial.write(bytes(2**16))  # a full disk says so only now
        return folder
    except OSError as error:
        reason = error.strerror
    try:
        own = Path(tempfile.mkdtemp(prefix="strikewave-"))
        if folder.is_dir():
            _copy(folder, own)
        atexit.register(shutil.rmtree, own, ignore_errors=True)
    except OSError:
        own = folder
        caching.UserProvidedCacheLocator.ensure_cache_path = lambda self: None  # it may be read all the same
    log.warning("kernels cannot be kept in %s (%s); this process keeps them in %s", folder, reason, own)
    return own


def _copy(folder: Path, own: Path) -> None:
    """The files of a folder, without its modes: in those, nothing may be written."""
    for each in sorted(folder.rglob("*")):
        copy = own / each.relative_to(folder)
        with suppress(PermissionError):  # what cannot be read is compiled again
            copy.mkdir(exist_ok=True) if each.is_dir() else shutil.copyfile(each, copy)


class _KernelFile(caching.IndexDataCacheFile):
    """A file of the cache that, damaged, only has its kernel compiled again: it is put aside, with a line in the log.

    Data has a checksum: machine code that is not what was written would be run all the same. What names a class or a
    module that these sources do not have comes from others, and is compiled again without a word. What cannot be
    written is not kept.
    """

    _told: ClassVar[set[str]] = set()  # of what this process has said in the log already

    def load(self, key: Any) -> Any:
        try:
            return super().load(key)
        except MISSING:
            return None
        except Exception:  # of damaged data pickle raises whatever it comes upon
            self._put_aside()
            return None

    def save(self, key: Any, data: Any) -> None:
        try:
            super().save(key, data)
        except OSError as error:
            self._warn("kernels that are compiled cannot be kept (%s)", error.strerror)

    def _load_index(self) -> dict[Any, str]:
        try:
            return super()._load_index()
        except MISSING:
            return {}

    def _load_data(self, name: str) -> Any:
        content = Path(self._data_path(name)).read_bytes()
        data = content[DIGEST_BYTES:]
        if sha256(data).digest() != content[:DIGEST_BYTES]:
            raise ValueError("checksum")
        return pickle.loads(data)

    def _save_data(self, name: str, data: Any) -> None:
        dumped = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(sha256(dumped).digest() + dumped)

    def _put_aside(self) -> None:
        self._warn("damaged kernels in %s are put aside and compiled again", self._cache_path)
        with suppress(OSError):
            os.replace(self._index_path, f"{self._index_path}.damaged")

    def _warn(self, sentence: str, *values: object) -> None:
        if sentence not in self._told:
            self._told.add(sentence)
            log.warning(sentence, *values)


DIGEST_BYTES = sha256().digest_size
MISSING = AttributeError, ImportError  # what pickle raises for a class or module that is not there
caching.IndexDataCacheFile = _KernelFile
caching.UserProvidedCacheLocator.get_source_stamp = lambda self: kernels_key(Path(self._py_file).resolve())
numba.config.CACHE_DIR = str(_usable(_cache_folder()))


def all_compiled() -> Path:
    """The file that stands in the cache once every usual kernel of these sources is compiled."""
    return Path(numba.config.CACHE_DIR) / f"compiled-{sources_key()}"
