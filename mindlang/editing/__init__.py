"""How an edit of a hierarchy is carried out: what it reads, how it writes, what becomes of the weights."""
