"""Batches of independent tasks that stop and start at will, on this machine's processes or on a Ray cluster; see README.md here."""

from egotouch_sdk.jobs.run import BatchResult, run_jobs
from egotouch_sdk.jobs.runner import Runner
from egotouch_sdk.jobs.task import Batch, Task

__all__ = ["Batch", "BatchResult", "Runner", "Task", "run_jobs"]
