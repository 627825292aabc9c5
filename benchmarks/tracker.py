"""Frames a second that the ball tracker does at 320×240, with noise: python benchmarks/tracker.py [--json]."""

import argparse
import json
import statistics
import time

import cv2
import numpy as np
from mindrun.numbers.arrays import Frame
from mindrun.robot.camera import BallCamera, find_ball

IMAGE_WIDTH, IMAGE_HEIGHT = 320, 240
FRAME_COUNT = 50


def frame(rng: np.random.Generator, balls: int) -> Frame:
    """A grey room with noise, so many luminous balls, and as many lamps that are none."""
    drawn = np.full((IMAGE_HEIGHT, IMAGE_WIDTH, 3), 60, np.uint8)
    for _ in range(balls):
        x, y, radius = int(rng.integers(IMAGE_WIDTH)), int(rng.integers(IMAGE_HEIGHT)), int(rng.integers(5, 30))
        cv2.circle(drawn, (x, y), radius, (60, 230, 60), -1, cv2.LINE_AA)
        cv2.circle(drawn, (IMAGE_HEIGHT - y, x % IMAGE_HEIGHT), radius, (255, 255, 255), -1)
    noisy: Frame = np.clip(drawn + rng.normal(0, 8, drawn.shape), 0, 255).astype(np.uint8)
    return noisy


def milliseconds(frames: list[Frame], rounds: int) -> list[float]:
    """How long each of them took, over and over."""
    taken = []
    for _ in range(rounds):
        for shown in frames:
            begin = time.perf_counter_ns()
            find_ball(shown, BallCamera())
            taken.append((time.perf_counter_ns() - begin) / 1e6)
    return taken


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--threads", type=int, default=1, help="of OpenCV; a robot has other things to do")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    cv2.setNumThreads(options.threads)
    rng = np.random.default_rng(1)
    found = []
    for balls in (0, 1, 20):
        taken = milliseconds([frame(rng, balls) for _ in range(FRAME_COUNT)], options.rounds)
        slow = statistics.quantiles(taken, n=100)[98]
        found.append({"balls": balls, "frames_a_second": 1000 / statistics.median(taken), "slowest_ms": slow})
    if options.json:
        print(json.dumps(found))
        return
    for row in found:
        print(
            f"{row['balls']:2d} balls: {row['frames_a_second']:5.0f} frames/s at {IMAGE_WIDTH}×{IMAGE_HEIGHT} "
            f"(median; 99 % within {row['slowest_ms']:.1f} ms)"
        )


if __name__ == "__main__":
    main()
