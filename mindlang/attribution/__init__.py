"""Why a run was as it was: who made a command, an influence or a reward."""
