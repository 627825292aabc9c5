"""A session of several viewers: a run and its forks, who may change them, and answers to what is asked."""

import asyncio
import os
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from math import isfinite
from typing import TYPE_CHECKING, Any

from mindrun.robot.order_client import drivers, say_order

from mindlang.attribution.shares import shares
from mindlang.compiler.diagnostic import listed
from mindlang.view import messages
from mindlang.view.about import order_data
from mindlang.view.learning import WATCH_SECONDS
from mindlang.view.messages import Message, RefusedError, shown
from mindlang.view.rows import DOUBLE_BLOCK, SINGLE_BLOCK
from mindlang.view.viewed import Viewed, data_url

if TYPE_CHECKING:
    from mindlang.view.learning import Learning


MAX_HAPPENED = 10_000  # events, and stops, that are told at once


class ViewSession:
    """A session in one event loop. Runs grow in a thread of their own, and answers are computed in another."""

    def __init__(self, viewed: Viewed, learning: "Learning | None" = None) -> None:
        self.changed: Callable[[], None] = lambda: None  # told whenever something has come
        self.learning = learning
        self.number = 0  # how many runs have been seen before this one
        self._growing: dict[int, asyncio.Task[None]] = {}
        self._show(viewed)
        self._grower = ThreadPoolExecutor(1, "growing")
        self._answerer = ThreadPoolExecutor(1, "answering")

    def begin(self) -> None:
        """Let what is live grow from now on, in the loop that is running."""
        if self.forks[0].is_live:
            self._run(0, sys.maxsize)

    def show(self, viewed: Viewed) -> None:
        self._show(viewed)
        self.number += 1
        self.begin()
        self.changed()

    def _show(self, viewed: Viewed) -> None:
        for growing in self._growing.values():
            growing.cancel()
        self._growing = {}
        self.forks = [viewed]
        self.forks_data: list[dict[str, Any]] = [{}]  # how each has begun
        self._wanted = [0]

    async def watch(self) -> None:
        """Look at trainings as long as somebody sees them."""
        loop = asyncio.get_running_loop()
        while self.learning:
            await asyncio.sleep(WATCH_SECONDS)
            if await loop.run_in_executor(self._answerer, self.learning.read):
                self.changed()

    def about(self, edits: bool) -> dict[str, Any]:
        """The first message to a viewer: the run, and the columns of its rows."""
        viewed = self.forks[0]
        columns = viewed.columns
        # It is what a robot drives, which began this process and takes orders.
        takes_orders = viewed.about["source"] == "robot" and os.getppid() in drivers()
        return {
            "say": "about",
            "edits": edits,
            "orders": order_data(viewed.flows.graph) if edits and takes_orders else [],
            "drive": viewed.about["by_hand"] if edits and (takes_orders or viewed.hand) else [],
            "doubles": columns.width(DOUBLE_BLOCK),
            "singles": columns.width(SINGLE_BLOCK),
            "columns": {name: [g.block, g.first, g.count] for name, g in columns.items()},
            **viewed.about,
        }

    def ticks(self, fork: int, happened: int = 0, stops: int = 0) -> dict[str, Any]:
        """The message on how far a fork has come, with its events and stops from those numbers on."""
        viewed = self.forks[fork]
        return {
            "say": "ticks",
            "fork": fork,
            "over": viewed.over,  # before what is known, which may grow meanwhile
            "known": viewed.known,
            "ended_by": viewed.ended_by,
            "failed": viewed.failed,
            "happened": viewed.happened[happened : happened + MAX_HAPPENED],
            "stops": viewed.stops[stops : stops + MAX_HAPPENED],
        }

    async def answer(self, message: Message, edits: bool) -> bytes | dict[str, Any] | None:
        """The answer to a message, None where there is none; RefusedError or MindError where it cannot be answered."""
        if message.fork >= len(self.forks):
            raise RefusedError(f"there is no fork {message.fork}")
        match message:
            case messages.AskRun(fork=fork, to=to):
                self._run(fork, to)
                self.changed()  # said also where the run is there already
                return None
            case (
                messages.AskChange()
                | messages.PlayChampion()
                | messages.SayOrder()
                | messages.SayHand()
                | messages.PlaySeed()
                | messages.WatchRobot()
            ) if not edits:
                raise RefusedError("somebody else may change this run: the first who opened it")
            case messages.PlayChampion():
                await self._play(message)
                return None
            case messages.AskChange():
                await self._fork(message)
                return None
            case messages.SayOrder(name=name, value=value):
                await asyncio.to_thread(say_order, name, value, os.getppid())
                return None
            case messages.SayHand(values=values):
                await self._drive(values)
                return None
            case messages.PlaySeed(seed=seed):
                await self._anew(None if seed is None else int(seed))
                return None
            case messages.WatchRobot(robot=robot):
                await self._watch(robot)
                return None
        viewed = self.forks[message.fork]  # another run may be seen when it is this question's turn
        return await asyncio.get_running_loop().run_in_executor(self._answerer, _computed, viewed, message)

    async def _drive(self, values: tuple[float, ...]) -> None:
        viewed = self.forks[0]
        names = [each["name"] for each in viewed.about["by_hand"]]
        if len(values) != len(names):
            raise RefusedError(f"the hand holds {listed(names, 'and') or 'nothing'}: that is not {len(values)}")
        for name, value in zip(names, values, strict=True):
            if viewed.hand:
                viewed.hand.say(name, value)
            else:
                await asyncio.to_thread(say_order, name, value, os.getppid())

    async def _anew(self, seed: int | None) -> None:
        anew = self.forks[0].anew
        if anew is None:
            raise RefusedError("nobody drives here in a simulated world")
        self.show(await asyncio.get_running_loop().run_in_executor(self._grower, anew, seed))

    async def _watch(self, robot: int) -> None:
        watched = self.forks[0].watched
        if watched is None:
            raise RefusedError("a recording is of one robot: mindc run --robot writes that of another")
        self.show(await asyncio.get_running_loop().run_in_executor(self._grower, watched, robot))

    async def _play(self, asked: messages.PlayChampion) -> None:
        if self.learning is None or asked.run >= len(self.learning.runs):
            raise RefusedError(f"there is no training {asked.run}")
        seed = None if asked.seed is None else int(asked.seed)
        given = asked.run, asked.attempt, asked.generation, seed
        self.show(await asyncio.get_running_loop().run_in_executor(self._grower, self.learning.begin, *given))

    async def _fork(self, change: messages.AskChange) -> None:
        """Fork a run, and let the fork go on at once to where that run is."""
        of = self.forks[change.fork]
        if of.forked is None:
            raise RefusedError("a recording is what it is: nothing in it can be changed")
        if len(self.forks) > messages.MAX_FORKS:
            raise RefusedError(f"there are {messages.MAX_FORKS} forks already: open the run anew")
        viewed, text = await asyncio.get_running_loop().run_in_executor(self._grower, of.forked, change)
        if of not in self.forks:
            raise RefusedError("another run is seen now")
        number = len(self.forks)
        told = {"say": "fork", "fork": number, "of": change.fork, "tick": change.tick, "text": text}
        self.forks_data.append(told)
        self._wanted.append(0)
        self.forks.append(viewed)
        self._run(number, max(of.known, change.tick))

    def _run(self, fork: int, to: int) -> None:
        self._wanted[fork] = max(self._wanted[fork], to)
        if fork not in self._growing or self._growing[fork].done():
            self._growing[fork] = asyncio.create_task(self._grow(fork))

    async def _grow(self, fork: int) -> None:
        viewed, loop = self.forks[fork], asyncio.get_running_loop()
        # Behind its last row a recording still has to say that it ends there, or that it is damaged.
        while not viewed.over and (viewed.known < self._wanted[fork] or viewed.known == viewed.about["of_ticks"]):
            elsewhere = sum(each.kept_bytes for each in self.forks if each is not viewed)
            await loop.run_in_executor(self._grower, viewed.grow, elsewhere)
            self.changed()


def _computed(viewed: Viewed, message: Message) -> bytes | dict[str, Any]:
    match message:
        case messages.AskRows():
            return viewed.rows(message)
        case messages.AskColumns():
            return viewed.some_columns(message)
        case messages.AskImage(fork=fork, tick=tick):
            return {"say": "image", "fork": fork, "tick": tick, "image": data_url(viewed.image(tick), "png")}
        case messages.AskShares():
            return command_shares(viewed, message)
    raise RefusedError("that is no question")


def command_shares(viewed: Viewed, asked: messages.AskShares) -> dict[str, Any]:
    """The contribution of each path to a command; RefusedError where there is no such actuator or tick."""
    flows, graph = viewed.flows, viewed.flows.graph
    if viewed.about["source"] == "environment":
        raise RefusedError("a program acts here: no path of influence has made its commands")
    if asked.actuator >= len(graph.actuators):
        raise RefusedError(f"there is no actuator {asked.actuator}")
    if asked.tick > viewed.known:
        raise RefusedError(f"tick {asked.tick} is not known yet")
    found = shares(flows, ("actuator", asked.actuator), range(asked.tick, asked.tick + 1))
    if not all(isfinite(number) for each in found.paths for number in (each.influence, each.share)):
        raise RefusedError(f"the influence of tick {asked.tick} is beyond all numbers")
    numbers = {(node["kind"], node["name"]): number for number, node in enumerate(viewed.about["nodes"])}
    end = numbers["actuator", shown(graph.actuators[asked.actuator].name)]
    return {
        "say": "why",
        "fork": asked.fork,
        "tick": asked.tick,
        "actuator": asked.actuator,
        "command": found.command,
        "neutral": found.neutral,
        "rounding": found.rounding,
        "paths": [
            {
                "path": [*(numbers["skill", shown(name)] for name in each.path[:-1]), end],
                "value": each.value,
                "influence": each.influence,
                "share": each.share,
            }
            for each in found.paths
        ],
        "rest": found.rest.share,
        "rest_paths": found.rest.paths,
    }
