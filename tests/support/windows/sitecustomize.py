"""On PYTHONPATH: an interpreter in which the package finds what Windows has, and nothing that POSIX alone has.

The standard library and others keep what their branches for this system need, but for whole modules; text files have to
say their encoding, which on Windows is another one.
"""

import os
import re
import select
import signal
import sys
import time
import types
import warnings
from typing import Any

GONE = ("fcntl", "grp", "pty", "pwd", "resource", "syslog", "termios", "tty")
HIDDEN: dict[types.ModuleType, str] = {
    os: r"""fork\w*|get(e?[ug]id|groups|pgid|pgrp|sid|res[ug]id|loadavg|priority)|set\w*id|setgroups|initgroups|killpg
    |l?chown|fchown|fchmod|fchdir|chroot|mkfifo|mknod|sched_\w+|f?statvfs\w*|(f?path|sys)conf\w*|confstr\w*|nice|uname\w*
    |wait|wait3|wait4|waitid|W[A-Z]+|p(read|write)v?|sendfile|posix_\w+|register_at_fork|ttyname|ctermid|openpty|pipe2
    |O_(NOFOLLOW|DIRECTORY|CLOEXEC|NONBLOCK|NDELAY|A?SYNC|DSYNC|RSYNC|NOCTTY|PATH|TMPFILE|DIRECT|ACCMODE)|lockf|F_\w+
    |memfd_create|MFD_\w+|eventfd\w*|copy_file_range|splice|sync|fdatasync|\w*xattr|set_blocking|get_blocking|login_tty""",
    signal: r"""SIG(KILL|HUP|ALRM|USR[12]|PIPE|QUIT|STOP|TSTP|CONT|CHLD|CLD|WINCH|TTIN|TTOU|XCPU|IO|POLL|PROF|VTALRM)
    |[gs]etitimer|ITIMER_\w+|alarm|pause|pthread_\w+|SIG_(UN)?BLOCK|SIG_SETMASK|sigwait\w*|sigtimedwait|sigpending
    |siginterrupt""",
    select: "e?poll|EPOLL\\w*|POLL\\w*",
    time: "tzset|p?thread_getcpuclockid|clock_[gs]et\\w*|CLOCK_\\w+",
    sys: "platform|abiflags|getdlopenflags|setdlopenflags",
}
INSTEAD = {"platform": "win32"}


def hide(module: types.ModuleType, names: str) -> None:
    """Take names from a module for all code of the package; others still find them."""
    kept = {name: value for name, value in vars(module).items() if re.fullmatch(re.sub(r"\s", "", names), name)}

    def found(name: str) -> Any:
        asks = sys._getframe(1).f_globals.get("__name__", "")
        if name in kept and not asks.startswith("jumpcad"):
            return kept[name]
        if name in kept and name in INSTEAD:
            return INSTEAD[name]
        raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")

    for name in kept:
        delattr(module, name)
    module.__getattr__ = found  # type: ignore[method-assign]


class Gone:
    """A finder that finds none of the modules that are gone."""

    def find_spec(self, name: str, *_: Any) -> None:
        """Refuse a module that Windows does not have."""
        if name in GONE:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


for gone in GONE:
    sys.modules.pop(gone, None)
sys.meta_path.insert(0, Gone())
for hidden, pattern in HIDDEN.items():
    hide(hidden, pattern)
warnings.filterwarnings("ignore", "only soft file lock")
warnings.filterwarnings("ignore", category=EncodingWarning)
warnings.filterwarnings("error", category=EncodingWarning, module="jumpcad")
