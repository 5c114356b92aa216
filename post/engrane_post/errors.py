# SPDX-License-Identifier: BSD-3-Clause
"""The one error that is the user's to mend."""


class UserError(Exception):
    """A sentence for the user: what is wrong and what would be right. Printed without a traceback, exit
    status 1."""


class Terminated(BaseException):
    """SIGTERM came: as KeyboardInterrupt, what is open gets closed and what is done gets written."""
