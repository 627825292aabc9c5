"""One tick of many worlds in lockstep.

A **lane** is one robot in its world; `lanes` of them are at work, numbered 0 to lanes − 1. The robots of a world are
neighbours: the first lane has its things, and the others copies of them (`sharing`). Every quantity is an array [row,
lane] (a few are [lane, column], some of records; `sim/state.py` says which), so that a loop over the lanes vectorises.
What is the same in all of them stands in `tables`: a row for each sensor, skill, edge, reward … of a mind and its task
(`sim/codes.py`). The compiled code is the same for every mind: it reads the tables.

`advance` runs ticks, each in six stages:

| stage | what it does | to which parts of the state |
|---|---|---|
| sense | readings, from where the robots and the things are | sight, mind |
| think | influence down the hierarchy (Eq. 2), what the skills send (Eq. 1) | mind |
| act | commands (Eq. 3), the claw | mind, world |
| step | physics: free flight, and `strides` where something could touch | world, contact |
| judge | measures, what is reached, events, rewards; `placement` of what was reached | judge, world, run |
| recall | memories, as they are read in the next tick | mind |

A stage is handed the whole `state`, what it calls the parts that it reads and writes. A skill runs only in the lanes in
which it has influence: `active[0..count]` are these, and what is gathered for it stands side by side in the columns
0 to count − 1.

All are plain functions. A `@unit` is compiled by itself, with what it calls, and can be called from Python; any other
function can be handed a row of a table, or a record of the state, and write into it. Compiled code owns nothing
(`_nrt=False`), so in it

- no array is made, and none is assigned to a slice: a loop instead (a number may be assigned to a slice);
- nothing is raised, and no index is looked at: tables and state are made to fit each other;
- the order of + − × ÷ is part of the result: the engine and plain Python give the same bits.
"""
