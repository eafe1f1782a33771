"""How much a visitor may take of the server; the tests beside go just below and beyond each limit."""

MAX_MESSAGE = 20_000  # bytes of one part of a message; the longest honest one has some hundreds
MAX_EVENTS = 32  # in one message; an honest page sends one to ten
# Parts of messages of one socket, three to a message: a page that is quick sends 60 messages a second.
PARTS_RATE, PARTS_BURST = 240.0, 120.0
PART_SECONDS = 3e-4  # of the event loop that reading a part takes; measured 0.1 to 0.3 ms
READ_AT_ONCE = 8  # parts of messages that are read in one round of the event loop: 2 ms
OVER_PAUSE = 0.5  # s between two parts that are read of a socket which sends more than it may
# Times a second that a choice may be set again without an answer, and at once: a page does it every 2.5 s, and a link
# that stands still for ten seconds delivers four of them together.
UNANSWERED_RATE, UNANSWERED_BURST = 0.5, 4.0
HASTY_SECONDS = 4.0  # for which there is a pause before each part that is read from who does not wait
HASTE_RATE, HASTE_BURST = 0.05, 4.0  # times a second, and at once, that this may begin; then the socket is closed
HASTE = 0.05  # s of the server's time that such a message counts as, when it is asked who has had least
MAX_OVER_SECONDS = 2.0  # for which a socket may send all it can; then it is closed
MAX_REFUSED = 200  # messages of one socket that are not allowed, before it is closed
MAX_WAITING = 64  # messages of one socket that wait; an honest page sends none before the last is answered
MAX_PAGES_OF_ONE = 150  # requests for the page that wait, of one address; of all, as many as there are connections
MAX_SESSIONS = 180  # 0.3 MB each, and a document; more than three classes
ADDRESS_SESSIONS = 30  # of one address, which keeps them when the server is full: a class; it takes six to fill it
MAX_BARRED = 1_000  # sessions that were turned out lately; a stranger may have a new one at any time
MAX_CLOSING = 100  # sockets that are closed and whose browsers have not answered to that
IDLE_SECONDS = 120.0  # after which a session that does nothing makes room, if the server is full
MAX_BODY = 100_000  # bytes of a request, other than a record
MAX_HEADER = 120_000  # bytes of its head
MAX_FIELDS = 1_000  # of a link; the page is shown, and what comes after them is not looked at
MAX_CONNECTIONS = 500  # that have no session: a class, with six of each browser
FILES = 65_536  # that this process asks for: connections, sockets of sessions, processes, kernels
