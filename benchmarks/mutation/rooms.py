"""The rooms that are tried: their files, and the tests nearest to them, the quickest first."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Room:
    """`files` are patterns below the repository's root, `but` those of them that are left out.

    With `interpreted` the lanes run in Python: to compile each mutant would take longer than its tests.
    """

    files: tuple[str, ...]
    tests: tuple[str, ...]
    but: tuple[str, ...] = ()
    interpreted: bool = False


R = "runtime/mindrun/"
QUICK_SENSORS = (
    "test_noise_is_even_and_no_more_than_said",
    "test_what_is_lost_reads_as_if_nothing_were_there",
    "test_what_is_seen_is_late",
)
QUICK_TASKS = (
    "test_carrying_and_delivering",
    "test_a_schedule_shrinks_with_every_success",
    "test_the_change_of_thrust",
    "test_conditions_and_loops_in_rewards",
    "test_a_delay_shifts_the_commands",
    "test_a_reading_that_is_not_a_number_reaches_no_actuator",
)
QUICK_WORLDS = (
    "test_a_task_that_is_gone_is_told",
    "test_an_earlier_lesson_is_known_too",
    "test_the_lesson_that_a_line_tells_of_is_known_by_curriculum_and_number",
)
MISPLACED = (
    *("box-in-box", "box-in-its-zone", "empty-battery", "item-half-in-wall", "item-in-reach-at-once"),
    *("no-room-for-the-robot", "place-in-grid", "place-in-obstacle", "place-in-wall", "place-outside", "starts-twice"),
    *("start-half-in-the-border", "start-in-box", "start-in-middle-of-plain", "start-in-wall", "start-on-item"),
    *("start-outside", "starts-on-goal", "too-many-copies", "two-of-one-name-in-one-place", "walker-way-in-wall"),
    "crowded-together",
)
QUICK_VIEWS = (
    "test_a_step_is_a_row_and_an_episode_a_run",
    "test_its_rows_are_those_of_a_recording",
    "test_while_nothing_comes_nothing_is_added",
    "test_the_end_of_an_episode_is_said",
    "test_what_the_hierarchy_does_around_a_skill_that_is_played_is_shown",
    "test_without_a_browser_the_address_is_logged",
    "test_another_way_to_render_is_refused",
)
QUICK_ENVIRONMENTS = (
    "test_gymnasium_finds_nothing_wrong",
    "test_every_task_has_a_name",
    "test_any_mind_has_a_name_without_being_registered",
    "test_a_mind_may_be_registered_twice",
    "test_the_mind_that_is_registered_last_has_the_name",
    "test_a_task_in_an_environment_of_gymnasium_is_refused",
    "test_layouts_are_drawn_from_the_seed",
    "test_it_is_seen_as_an_image",
    "test_what_is_not_there_is_said",
    "test_actions_of_another_shape_are_refused",
)
QUICK_STEPPERS = (
    "test_an_environment_that_ends_its_process_is_told_with_step_and_seed",
    "test_a_program_goes_on_with_other_environments_and_with_the_same",
    "test_its_process_ends_with_it_whatever_thread_an_environment_has_left",
    "test_it_comes_to_the_same_bits_there_as_here",
    "test_an_image_that_ends_the_process_is_a_sentence",
    "test_what_it_does_to_its_process_it_does_to_no_other",
    "test_an_environment_that_does_not_come_back_is_killed_and_told",
)
KINDS_PAGE = "tests/explain/test_pages.py::test_what_is_published_is_what_the_program_says[kinds.md]"
BREAKPOINTS = "format", "messages", "report", "watch", "recorded", "check_command", "run_command"
GUARDIAN = ("frames", "urgent", "main", "decisions", "guard", "plan", "output", "serving", "client", "process")
ROOMS = {
    "engine": Room(
        tuple(f"{R}{name}.py" for name in ("engine/engine", "numbers/expression", "numbers/arrays")),
        tuple(f"tests/engine/test_{name}.py" for name in ("influence", "sound", "procedure", "bits")),
    ),
    "functions": Room(
        (f"{R}kinds/functions/*.py",),
        (
            "tests/engine/test_procedure.py",
            "tests/language/test_procedures.py",
            *(f"tests/functions/test_{name}.py" for name in ("recurrent_mind", "recurrent")),
            "tests/engine/test_bits.py",
            "tests/edits/test_weights.py",
            "tests/sim/test_lanes.py",
        ),
        interpreted=True,
    ),
    "sensors": Room(
        (f"{R}kinds/sensors/*.py", f"{R}numbers/arithmetic.py"),
        (
            "tests/sensors/test_compass.py",
            KINDS_PAGE,
            "tests/sensors/test_nearest.py",
            "tests/sensors/test_constants.py",
            "tests/sensors/test_derived.py",
            "tests/sim/test_directions.py",
            "tests/sensors/test_readings.py",
            *(f"tests/sim/test_rough_sensors.py::{name}" for name in QUICK_SENSORS),
            "tests/sim/test_tasks.py",
            "tests/sim/test_full_worlds.py",
            "tests/sim/test_engine_and_lanes.py",
            "tests/lint/test_rule_cases.py",
            "tests/engine/test_bits.py",
            "tests/sim/test_random_worlds.py",
        ),
        interpreted=True,
    ),
    "think": Room((f"{R}engine/think.py",), ("tests/engine/test_influence.py", "tests/engine/test_bits.py")),
    "lanes": Room(
        (f"{R}sim/lanes/*.py",),
        (
            "tests/sim/test_lanes.py",
            *(f"tests/sim/test_rough_sensors.py::{name}" for name in QUICK_SENSORS),
            *(f"tests/sim/test_tasks.py::{name}" for name in QUICK_TASKS),
            "tests/sim/test_order.py",
            "tests/sim/test_physics.py::test_contacts_equal_plain_pymunk",
            "tests/sim/test_contacts.py",
            "tests/sim/test_bodies.py::test_every_body_moves_and_touches_as_in_plain_pymunk[0-car]",
            "tests/sim/test_loose.py",
            "tests/sim/test_procedures.py::test_compiled_slow_and_rule_agree",
            "tests/sim/test_full_worlds.py",
            "tests/sim/test_random_worlds.py",
            "tests/sim/test_outcomes.py",
        ),
        interpreted=True,
    ),
    "outside": Room(
        (f"{R}sim/outside/*.py", f"{R}kinds/environment.py", "mindlang/compiler/resolve/outside.py"),
        (
            *(
                f"tests/outside/test_{name}.py"
                for name in ("misfits", "pictures", "outside_rollout", "drawn_minds", "repeating")
            ),
            KINDS_PAGE,
            "tests/language/test_messages.py",
            "tests/outside/test_hostile.py",
            *(f"tests/outside/test_subprocess_stepper.py::{name}" for name in QUICK_STEPPERS),
            "tests/outside/test_commands.py",
        ),
    ),
    "train": Room(
        tuple(
            f"{R}train/{name}.py"
            for name in ("ask_and_tell", "attempts", "lesson_state", "scoring", "training", "checkpoint", "progress")
        ),
        (
            "tests/train/test_genetic.py",
            "tests/train/test_lesson.py",
            "tests/train/test_standing.py",
            "tests/train/test_checkpoint.py",
            "tests/train/test_progress.py",
            "tests/train/test_strange_run.py",
            "tests/train/test_run_folder.py",
            "tests/train/test_evolution_strategy.py",
            "tests/train/test_attempts.py",
        ),
    ),
    "lock": Room(
        ("mindlang/lock/*.py",),
        (
            *(
                f"tests/lock/test_{name}.py"
                for name in ("signature", "wording", "lock", "worlds", "trained", "accept", "garbage", "status_command")
            ),
            "tests/likeness/test_lock.py",
            "tests/language/test_starts.py::test_another_start_is_another_world",
        ),
    ),
    "bundle": Room(
        tuple(f"{R}graph/{name}.py" for name in ("bundle", "codec", "policy", "validate", "weights")),
        (
            *(f"tests/engine/test_{name}.py" for name in ("sound", "npy", "older", "resealed_bundle", "weights")),
            *(f"tests/engine/test_{name}.py" for name in ("bundle", "encoding", "influence")),
            "tests/api/test_python.py::test_weights_never_meet_a_graph_in_another_order",
        ),
    ),
    "recording": Room(
        (f"{R}robot/recording.py", f"{R}robot/replay.py"),
        tuple(f"tests/robot/test_{name}.py" for name in ("recording", "background_file", "recorded_world")),
    ),
    "guardian": Room(
        (f"{R}robot/guardian/*.py",),
        tuple(f"tests/robot/guardian/test_{name}.py" for name in GUARDIAN),
    ),
    "proofs": Room(
        ("mindlang/proofs/*.py",),
        (
            *(f"tests/proofs/test_{name}.py" for name in ("said", "intervals", "claims", "cutting", "reaching")),
            "tests/proofs/test_recorded.py::test_a_run_without_influence",
            *(f"tests/proofs/test_{name}.py" for name in ("paths", "bounds", "prove_command")),
        ),
        interpreted=True,
    ),
    "why": Room(
        ("mindlang/attribution/*.py",),
        (
            *(f"tests/why/test_{name}.py" for name in ("report", "why_command", "why_recording")),
            *(f"tests/run/test_{name}.py" for name in ("edge_flow", "shares")),
        ),
    ),
    "whatif": Room(
        ("mindlang/whatif/*.py",),
        tuple(f"tests/run/test_{name}.py" for name in ("whatif_texts", "whatif", "whatif_recording")),
    ),
    "breakpoints": Room(
        ("mindlang/breakpoints/*.py",), tuple(f"tests/breakpoints/test_{name}.py" for name in BREAKPOINTS)
    ),
    "environments": Room(
        ("mindlang/environments/*.py",),
        (
            *(f"tests/environments/test_{name}.py" for name in ("extras", "same_run", "given", "task_vector_env")),
            *(f"tests/environments/test_live_view.py::{name}" for name in QUICK_VIEWS),
            *(f"tests/environments/test_task_env.py::{name}" for name in QUICK_ENVIRONMENTS),
        ),
        but=("mindlang/environments/stable_baselines.py",),  # whose tests need a library that a mutant's may not have
    ),
    "importing": Room(
        ("mindlang/weights/*.py",),
        (
            *(f"tests/weights/test_{name}.py" for name in ("commands", "files", "network", "without_torch")),
            "tests/outside/test_weights_from_elsewhere.py",
        ),
        but=("mindlang/weights/torch_skill.py",),  # whose tests need a library that a mutant's may not have
    ),
    "beginnings": Room(
        (
            *(f"mindlang/compiler/{name}.py" for name in ("beginning", "resolve/worlds")),
            *(f"mindlang/lint/rules/{name}.py" for name in ("crowded_world", "lessons", "walled_off", "worlds")),
        ),
        (
            "tests/lint/test_floor.py",
            *(f"tests/language/test_messages.py::test_one_message_for_one_mistake[{name}]" for name in MISPLACED),
            "tests/lint/test_world_rules.py",
            "tests/lint/test_paid_at_once.py",
            "tests/lint/test_crowded_world.py::test_the_cheaper_a_world_is_the_more_are_drawn",
            "tests/sim/test_drawn_world.py",
            "tests/language/test_starts.py",
            "tests/lint/test_rules.py",
            "tests/sim/test_beginnings.py",
        ),
    ),
    "names": Room(
        (
            *(f"mindlang/editing/{name}.py" for name in ("world_names", "lock_update")),
            *(f"mindlang/lock/{name}.py" for name in ("__init__", "status")),
        ),
        (
            "tests/likeness/test_lock.py",
            "tests/lock/test_trained.py",
            *(f"tests/train/test_{name}.py" for name in ("teaching", "lesson_order")),
            *(f"tests/lock/test_worlds.py::{name}" for name in QUICK_WORLDS),
            *(f"tests/edits/test_{name}.py" for name in ("weights", "neighbours")),
            *(f"tests/lock/test_{name}.py" for name in ("accept", "merging", "status_command")),
            "tests/edits/test_renames.py::test_what_no_mind_says_any_more_is_read_with_the_new_names",
            "tests/edits/test_renames.py::test_a_rename_of_anything_in_any_mind",
        ),
    ),
    "numbers": Room(
        (
            *(
                f"{R}{name}.py"
                for name in (
                    "graph/measured",
                    "graph/tasks",
                    "numbers/given_numbers",
                    "errors",
                    "numbers/short_repr",
                )
            ),
            *(f"mindlang/{name}.py" for name in ("lint/intervals", "run/paired_difference", "robot/claims")),
            *(f"mindlang/lint/rules/{name}.py" for name in ("values", "robot")),
        ),
        (
            "tests/run/test_paired_difference.py",
            "tests/lint/test_intervals.py",
            "tests/language/test_nearest_name.py",
            "tests/api/test_short_repr.py",
            "tests/robot/test_given_numbers.py",
            "tests/run/test_used_sensors.py",
            "tests/wiring/test_speed.py",
            "tests/wiring/test_messages.py",
            "tests/lint/test_number_rules.py",
            "tests/run/test_one_world.py",
            "tests/lint/test_rules.py",
            "tests/sim/test_top_speed.py",
        ),
    ),
}
