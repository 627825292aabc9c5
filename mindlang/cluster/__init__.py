"""Dask clusters: where the scheduler of one is and whether it may be talked to, jobs given to it, jobs done in it."""
