"""It ends who imports it."""

import os

os._exit(0)
