"""Where compiled kernels of this library are kept, and when they are made again; those of others are left alone."""

import atexit
import inspect
import logging
import os
import pickle
import platform
import re
import shutil
import sys
import tempfile
import threading
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any, ClassVar

import numba
from llvmlite import binding as llvm
from numba.core import caching

from . import compiling, machine_code, shortcuts

log = logging.getLogger("strikewave")
LIBRARY = Path(__file__).resolve().parents[1]
ROOM = 2**20  # bytes: the largest kernel has as many
SAID = "text", "validation.py"  # refusals and notes, of which machine code has nothing
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
    the tuples they are given: of contact laws, of files that import theirs, and of linkages beside them.
    """
    return _key_of(_sources_of(source))


def _sources_of(source: Path) -> set[Path]:
    laws, numerics = LIBRARY.glob("contact/*.py"), LIBRARY / "numerics"
    callers = (*numerics.rglob("*.py"), LIBRARY / "stability" / "integrators.py")
    users = (each for each in callers if source in _imports(each))
    linkages = (numerics / "multibody").glob("*.py") if source.parent.name == "multibody" else ()
    return _closure(source).union(*map(_closure, (*laws, *users, *linkages)))


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
    """Files of the library that this one imports by name, but for what is `SAID`, and what a package collects in its
    `__init__`.
    """
    found = set()
    for dots, module, names in IMPORTED.findall(source.read_text(encoding="utf-8")):
        folder = source.parents[len(dots) - 1].joinpath(*module.split("."))
        found |= {folder.with_suffix(".py")} if module else set()
        found |= {folder / f"{name}.py" for name in re.findall(r"\w+", names)}
    said = [LIBRARY / each for each in SAID]
    return frozenset(each for each in found if each.is_file() and not any(map(each.is_relative_to, said)))


def cache_home() -> Path:
    """Where this user's programs keep what they can make again."""
    return Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")) / "strikewave"


def keep_text(path: Path, text: str) -> None:
    """Write a file of the user's cache. Raises OSError where nothing can be kept."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, text)


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file so that whoever reads it sees all of it or none, whoever else writes it. Raises OSError where it
    cannot be written; then what was there before is there still."""
    beside = path.with_name(f"{path.name}.{os.getpid()}.{threading.get_ident()}")  # its own
    try:
        beside.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        beside.replace(path)
    finally:  # after an interrupt, too
        beside.unlink(missing_ok=True)


def _cache_folder() -> Path:
    given = os.environ.get("NUMBA_CACHE_DIR")
    return Path(given) if given else cache_home() / ("checked-kernels" if numba.config.BOUNDSCHECK else "kernels")


def _usable(folder: Path) -> Path:
    """The folder if files can be kept in it; else a temporary one with what is in it; else it as it is, to read."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _try(folder)
        return folder
    except OSError as error:
        reason = error.strerror
    try:
        own = Path(tempfile.mkdtemp(prefix="strikewave-"))
        atexit.register(shutil.rmtree, own, ignore_errors=True)
        if folder.is_dir():
            _copy(folder, own)
    except OSError:
        own = folder  # it may be read all the same
    log.warning("kernels cannot be kept in %s (%s); this process keeps them in %s", folder, reason, own)
    return own


def _try(folder: Path) -> None:
    """Raises OSError if no files can be kept there."""
    with tempfile.TemporaryFile(dir=folder) as trial:
        trial.write(bytes(ROOM))  # a full disk says so only now


def can_keep() -> bool:
    """Whether what is compiled now can be kept for other processes. Takes a millisecond, and writes."""
    try:
        _try(FOLDER)
    except OSError:
        return False
    return True


def _copy(folder: Path, own: Path) -> None:
    """The files of a folder, without its modes: in those, nothing may be written."""
    for each in sorted(folder.rglob("*")):
        copy = own / each.relative_to(folder)
        with suppress(PermissionError):  # what cannot be read is compiled again
            copy.mkdir(exist_ok=True) if each.is_dir() else shutil.copyfile(each, copy)


class _KernelFile(caching.IndexDataCacheFile):
    """A file of the cache that, damaged, only has its kernel compiled again: it is put aside, with a line in the log.

    Data has a checksum: machine code that is not what was written would be run all the same. What names a class or a
    module that these sources do not have comes from others, and is compiled again without a word. What another Numba
    or another processor left is compiled again, with a line. What cannot be written is not kept.
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
            os.makedirs(self._cache_path, exist_ok=True)
            super().save(key, data)
        except OSError as error:
            self._warn("kernels that are compiled cannot be kept (%s)", error.strerror)

    def _load_index(self) -> dict[Any, str]:
        try:
            return super()._load_index()
        except MISSING:
            return {}

    def tell_of_others(self, key: Any) -> None:
        """One line if there are kernels of this signature for another processor, or of these sources by another Numba.

        `key`: the signature, and what Numba tells processors by.
        """
        with suppress(Exception), open(self._index_path, "rb") as file:  # of a damaged file more has been said
            version = pickle.load(file)
            if version != self._version:
                line = "kernels in %s are of Numba %s; for %s they are compiled again"
                self._warn(line, FOLDER, version, self._version)
                return
            others = [each[1] for each in pickle.load(file)[1] if each[0] == key[0] and each[1] != key[1]]
            if others:
                line = "kernels in %s are for another processor (%s); they are compiled again"
                self._warn(line, FOLDER, others[0][1])

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
FOLDER = _usable(_cache_folder())


class _Place(caching._CacheLocator):
    """Where the kernels of a file are kept, and the key of the sources that they come from."""

    def __init__(self, function: Callable, file: str):
        self._py_file = file  # named as Numba's own, which its messages read
        self._line = function.__code__.co_firstlineno

    def get_cache_path(self) -> str:
        return str(FOLDER / self.get_suitable_cache_subpath(self._py_file))

    def get_source_stamp(self) -> str:
        return kernels_key(Path(self._py_file).resolve())

    def get_disambiguator(self) -> str:
        return str(self._line)


class _Results(caching.CompileResultCacheImpl):
    """What is kept of a compiled function, in a place that neither settings nor Numba's own places change."""

    def __init__(self, function: Callable):
        file = inspect.getfile(function)
        self._lineno = function.__code__.co_firstlineno
        self._locator = _Place(function, file)
        name = f"{Path(file).stem}.{function.__qualname__}"
        self._filename_base = self.get_filename_base(name, getattr(sys, "abiflags", ""))

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        if machine_code.unoptimised(payload) and not shortcuts.applied():
            return None
        return super().rebuild(target_context, payload)


class KernelCache(caching.FunctionCache):
    """The cache of one kernel, which its dispatcher is given in place of the one that Numba would take."""

    _impl_class = _Results

    def __init__(self, function: Callable):
        super().__init__(function)
        results = self._impl
        self._cache_file = _KernelFile(self._cache_path, results.filename_base, results.locator.get_source_stamp())

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kernel for a signature, or None.

        Raises:
            NotCompiled: there is none, within `compiling.compiled_only()`.
        """
        found = super().load_overload(sig, target_context)
        if found is None:
            self._cache_file.tell_of_others(self._index_key(sig, target_context.codegen()))
            compiling.refuse(self._py_func)
        return found


def all_compiled() -> Path:
    """The file that stands in the cache once every usual kernel of these sources is compiled, for this processor."""
    processor = numba.config.CPU_NAME or llvm.get_host_cpu_name(), numba.config.CPU_FEATURES, platform.machine()
    host = repr((numba.__version__, sys.version_info[:2], processor))
    return FOLDER / f"compiled-{sources_key()}-{sha256(host.encode()).hexdigest()[:6]}"
