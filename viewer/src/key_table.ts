/** Which key does what. */

import { element } from "./elements";
import type { Hierarchy } from "./hierarchy";
import type { Key } from "./keys";
import type { Playback } from "./playback";
import type { Timeline } from "./timeline";
import type { World } from "./world";

const STEP_TICKS = 10;
const ZOOM = 1.25;

/** What keys act on. */
interface Parts {
  playback: Playback;
  timeline: Timeline;
  hierarchy: Hierarchy;
  world: World | null;
  follow: () => void;
  nextRobot: () => void;
}

export function keysOf({ playback, timeline, hierarchy, world, follow, nextRobot }: Parts, search: () => void, help: () => void): Key[] {
  const to = (direction: 1 | -1) => {
    const found = timeline.next(playback.tick, direction);
    if (found) playback.jump(found.tick);
  };
  return [
    { keys: [" "], shown: "space", says: "play, pause", act: () => playback.toggle() },
    { keys: ["ArrowLeft"], shown: "\u2190", says: "one tick back", act: () => playback.step(-1) },
    { keys: ["ArrowRight"], shown: "\u2192", says: "one tick on", act: () => playback.step(1) },
    { keys: ["Shift+ArrowLeft"], shown: "shift \u2190", says: "ten ticks back", act: () => playback.step(-STEP_TICKS) },
    { keys: ["Shift+ArrowRight"], shown: "shift \u2192", says: "ten ticks on", act: () => playback.step(STEP_TICKS) },
    { keys: ["["], shown: "[", says: "to the event before", act: () => to(-1) },
    { keys: ["]"], shown: "]", says: "to the next event", act: () => to(1) },
    { keys: ["Home"], shown: "Home", says: "to the beginning", act: () => playback.jump(0) },
    { keys: ["End"], shown: "End", says: "to the end; of a run that goes on, stay with it", act: () => playback.end() },
    { keys: ["+", "="], shown: "+", says: "faster", act: () => playback.faster(1) },
    { keys: ["-", "_"], shown: "\u2212", says: "slower", act: () => playback.faster(-1) },
    { keys: ["z"], shown: "z", says: "hierarchy larger", act: () => hierarchy.zoom(ZOOM) },
    { keys: ["Z"], shown: "shift z", says: "hierarchy smaller", act: () => hierarchy.zoom(1 / ZOOM) },
    { keys: ["0"], shown: "0", says: "show all of both", act: () => (hierarchy.fit(), world?.fit()) },
    { keys: ["f"], shown: "f", says: "stay with the robot, or no more", act: follow },
    { keys: ["r"], shown: "r", says: "of several robots, the mind of the next; or click one", act: nextRobot },
    { keys: ["t"], shown: "t", says: "light or dark", act: () => element("theme").click() },
    { keys: ["/"], shown: "/", says: "search", act: search },
    { keys: ["?"], shown: "?", says: "this help", act: help },
  ];
}
