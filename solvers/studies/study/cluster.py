"""Who solves the points of a study: a cluster of Dask, or processes of this machine that stand for one."""

import asyncio
import logging
import pickle
import re
import signal
import socket
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any
from urllib.parse import urlsplit
from uuid import uuid4

from threadpoolctl import threadpool_limits

from ...numerics.processors import MOST
from ...provenance import version
from ...text.notes import Note
from ...validation import SceneError, allowed
from .work import Part, Work

REACH = 4.0  # s for the machine of the scheduler to answer
GREET = 5.0  # s for the scheduler to do so
COUNT = 1.0  # s between counts of workers
PATIENCE = "365d"  # for processes of `local:N` that have ended to be there again
LEAVE = 60.0  # s, at most, for parts that were cancelled to end
LOOK = 0.05  # s between looks at whether they have
LOCAL = re.compile(r"local:(\d{1,4})")
NAME = "strikewave"  # how keys of parts begin
PRELOAD = [__name__]  # by processes of `local:N`


class Cluster:
    """All workers of a cluster, whether they were there before or come later; its first part may be on any of them."""

    def __init__(self, client: Any, address: str, end: ExitStack):
        from distributed import KilledWorker

        self.client, self.address, self.end = client, address, end
        self.broken: tuple[type[BaseException], ...] = (KilledWorker,)
        self.running: set[Future[Any]] = set()
        self.task, self.here = _task(), version()
        self.study, self.submitted = uuid4().hex, 0
        self.packed: dict[int, tuple[Callable[..., Any], bytes]] = {}  # by the id of what is called, that and it packed
        self.counted, self.threads = -COUNT, 1

    @property
    def workers(self) -> int:
        """Threads of all workers, as they come and go; one while there are none, as some may come."""
        if time.monotonic() - self.counted > COUNT:
            with suppress(OSError, TimeoutError):
                self.threads = sum(self.client.nthreads().values())
            self.counted = time.monotonic()
        return max(1, self.threads)

    def check(self) -> None:
        """Raises SceneError for a worker of another version, or without the library."""
        for worker, there in self.client.run(_version(), on_error="return").items():
            if there != self.here and not isinstance(there, OSError):  # of one that has ended meanwhile
                raise self._refused(allowed("cluster-version", here=self.here, there=_said(there), worker=worker))

    def check_there(self) -> None:
        """Raises SceneError once its scheduler does not answer any more."""
        if self.client.status != "running":
            raise self._refused(allowed("cluster-lost"))

    def submit(self, work: Callable[..., Any], rows: Any) -> "Future[Any]":
        """Begin one part. What its worker refuses is a SceneError."""
        if id(work) not in self.packed:
            import cloudpickle

            self.packed[id(work)] = work, cloudpickle.dumps(work)
        self.submitted += 1
        key = f"{NAME}-{self.study}-{self.submitted}"
        sent = self.client.submit(self.task, self.here, self.packed[id(work)][1], rows, key=key, pure=False)
        found: Future[Any] = Future()
        self.running.add(found)
        found.add_done_callback(self.running.discard)
        found.add_done_callback(lambda found: sent.cancel() if found.cancelled() else None)
        self.client.loop.add_callback(self._answer, sent, found)
        return found

    async def _answer(self, sent: Any, found: "Future[Any]") -> None:
        """What has come of a part, as it is on the cluster."""
        from distributed import CancelledError

        answer: Any = None
        error: BaseException | None = None
        try:
            answer = await sent
        except self.broken as ended:
            error = ended
        except CancelledError:  # by nobody here: then `found` is cancelled
            error = self._refused(allowed("cluster-lost"))
        except Exception as failed:
            error = self._refused(allowed("cluster-loads", why=_said(failed)))
        if error is None and isinstance(answer, tuple):
            there, worker = answer
            error = self._refused(allowed("cluster-version", here=self.here, there=there, worker=worker))
        if found.set_running_or_notify_cancel():
            found.set_result(answer) if error is None else found.set_exception(error)

    def _refused(self, reason: Note) -> SceneError:
        return SceneError("cluster", self.address, reason)

    def renew(self) -> None:
        """Nothing is under way any more, so that what runs next is alone. Dask itself begins workers again."""
        self._cancel()
        deadline = time.monotonic() + LEAVE
        while self._busy() and time.monotonic() < deadline:
            time.sleep(LOOK)

    def _busy(self) -> bool:
        """Whether some worker is still at a part of this study."""
        try:
            stacks = self.client.call_stack()
        except (OSError, TimeoutError):  # of one that has ended meanwhile
            return True
        return any(self.study in str(key) for keys in stacks.values() for key in keys)

    def alone(self, work: Work, rows: list) -> Part | None:
        """With nothing else of this study on the cluster; None if its worker ends, as often as the cluster allows."""
        try:
            return self.submit(work, rows).result()
        except self.broken:
            return None

    def _cancel(self) -> None:
        for found in list(self.running):
            found.cancel()

    def close(self) -> None:
        """Nothing of it stays on a cluster that was there before; one that was begun here ends."""
        with self.end:
            self._cancel()


def check_address(said: str) -> None:
    """Raises SceneError for what is no address of a cluster, and without Dask; whether anybody answers is not tried."""
    _check_package(said)
    if local := LOCAL.fullmatch(said):
        good = 1 <= int(local[1]) <= MOST
    else:
        try:
            address = urlsplit(said)
            good = address.scheme in ("tcp", "tls") and address.hostname and address.port and not address.path
        except ValueError:
            good = False
    if not good:
        raise SceneError("cluster", said, allowed("cluster", most=MOST))


def cluster_of(said: Any) -> Cluster:
    """Of `study`'s argument. Raises SceneError for what is none, and for one that does not answer or cannot be used."""
    with ExitStack() as stack:
        if isinstance(said, str):
            check_address(said)
            stack.enter_context(_quiet())
            client = _local(said, stack) if LOCAL.fullmatch(said) else _reached(said)
            stack.callback(client.close)
        else:
            _check_package(said)
            client = _given(said)
        cluster = Cluster(client, said if isinstance(said, str) else client.scheduler.address, stack)
        cluster.check()
        cluster.end = stack.pop_all()
    return cluster


def _check_package(said: Any) -> None:
    if find_spec("distributed") is None:
        raise SceneError("cluster", said, allowed("cluster-package"))


def _given(client: Any) -> Any:
    from distributed import Client

    if not isinstance(client, Client) or client.asynchronous or client.status != "running":
        raise SceneError("cluster", client, allowed("cluster", most=MOST))
    return client


def _local(said: str, stack: ExitStack) -> Any:
    """A client of new processes, which nobody else can reach from another machine."""
    from dask.config import set as configured
    from distributed import Client, LocalCluster

    # Those that have ended begin again, however long that takes: after 15 s each is given up for good otherwise.
    stack.enter_context(configured({"distributed.deploy.lost-worker-timeout": PATIENCE}))
    # A process that ends has been ended by its point, as it has in `Processes`; pages are for those who ask for them.
    with configured({"distributed.scheduler.allowed-failures": 0, "distributed.scheduler.http.routes": []}):
        cluster = LocalCluster(
            n_workers=int(said.partition(":")[2]),
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address=None,  # pyright: ignore[reportArgumentType]
            scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
            memory_limit=0,
            silence_logs=logging.CRITICAL,
            preload=PRELOAD,
        )
    stack.callback(cluster.close)
    return Client(cluster, set_as_default=False)


def _reached(said: str) -> Any:
    """A client of the scheduler at this address."""
    from distributed import Client

    address = urlsplit(said)
    try:
        socket.create_connection((address.hostname or "", address.port or 0), REACH).close()
        with ThreadPoolExecutor(1) as pool:  # as this thread may have a loop of its own, in a notebook
            pool.submit(asyncio.run, _greeted(said)).result()
        return Client(said, timeout=GREET, set_as_default=False, name=NAME)
    except Exception as error:  # whatever a server says that is another one
        raise SceneError("cluster", said, allowed("cluster-answers", why=_said(error))) from None


async def _greeted(address: str) -> None:
    """Raises OSError or TimeoutError where it is not Dask that answers: a client would wait for ever."""
    from distributed import Security
    from distributed.comm.core import connect

    found = await asyncio.wait_for(connect(address, **Security().get_connection_args("client")), GREET)
    await found.close()


def _said(answer: Any) -> str:
    """A version, or in one line why there is none."""
    if isinstance(answer, str):
        return answer
    return f"{type(answer).__name__}: {answer}".partition("\n")[0][:200].rstrip(": ")


@contextmanager
def _quiet() -> Iterator[None]:
    """Dask logs nothing meanwhile: what is to be known is raised."""
    import_module("distributed")  # which sets up its loggers
    names = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] == "distributed"]
    loggers = [logging.getLogger(name) for name in names]
    before = {handler: handler.level for logger in loggers for handler in logger.handlers}
    heard = [logger for logger in loggers if not logger.disabled]
    for handler in before:
        handler.setLevel(logging.CRITICAL + 1)
    for logger in heard:  # whose lines may go to handlers of who has called
        logger.disabled = True
    try:
        yield
    finally:
        for handler, level in before.items():
            handler.setLevel(level)
        for logger in heard:
            logger.disabled = False


# What workers call goes there whole, as functions within functions do: their library may be another one.


def _version() -> Any:
    def there() -> str:
        from solvers.provenance import version

        return version()

    return there


def _task() -> Any:
    def part(here: str, packed: bytes, rows: Any) -> Any:
        """A Part, or a Receipt; or, if the library is of another version, that and where it is."""
        from solvers.provenance import version

        if version() != here:
            from distributed import get_worker

            return version(), get_worker().address
        from solvers.studies.study.cluster import solved_here

        return solved_here(packed, rows)

    return part


def solved_here(packed: bytes, rows: Any) -> Any:
    """One part, in a worker."""
    _ready()
    return pickle.loads(packed)(rows)


@cache
def _ready() -> None:
    threadpool_limits(1, user_api="blas")


def dask_setup(worker: Any) -> None:
    """Of a worker that loads this beforehand: its first part waits for nothing but kernels."""
    _ready()
    if getattr(worker, "nanny", None):  # which hears interrupts, or whoever began that
        signal.signal(signal.SIGINT, signal.SIG_IGN)
