"""Machine code by LLVM: made of a module for a kind of processors, loaded, and found by a name."""

import os
from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

from llvmlite import binding as llvm

SPEED_LEVEL = 3  # as -O3


class Target(NamedTuple):
    """What machine code is made for, as LLVM writes it."""

    triple: str
    processor: str
    features: str


@cache
def target() -> Target:
    """This very processor, or the one that NUMBA_CPU_NAME and NUMBA_CPU_FEATURES name."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    name, features = os.environ.get("NUMBA_CPU_NAME"), os.environ.get("NUMBA_CPU_FEATURES")
    if not name:
        name, found = llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
        features = found if features is None else features
    return Target(llvm.get_process_triple(), name, features or "")


def machine_code(module: Any, name: str) -> bytes:
    """The object file of a module, of which others can call the function with this name alone."""
    machine = _machine()
    for each in (*module.functions, *module.global_variables):
        if not each.is_declaration and each.name != name:
            each.linkage = "internal"  # what it is handed and does not need falls away
    without_variables_in_memory(module, _passes(machine, 0))
    passes = _passes(machine, SPEED_LEVEL)
    passes.getModulePassManager().run(module, passes)
    return bytes(machine.emit_object(module))


def without_variables_in_memory(module: Any, builder: Any) -> None:
    """Take variables out of memory: who inlines these functions has less to optimise."""
    passes = llvm.create_new_module_pass_manager()
    passes.add_sroa_pass()
    passes.add_instruction_combine_pass()
    passes.add_simplify_cfg_pass()
    passes.run(module, builder)


def load(code: bytes, name: str, known: Mapping[str, int]) -> int:
    """The address of the function with a name in an object file; `known` are the addresses of what it names."""
    for symbol, address in known.items():
        llvm.add_symbol(symbol, address)
    engine = _engine()
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return int(engine.get_function_address(name))


@cache
def _engine() -> Any:
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())


def _machine() -> Any:
    triple, processor, features = target()
    return llvm.Target.from_triple(triple).create_target_machine(
        cpu=processor, features=features, opt=SPEED_LEVEL, codemodel="jitdefault", jit=True,
        reloc="static" if triple.startswith(("x86", "i")) else "default",  # as numba has it
    )  # fmt: skip


def _passes(machine: Any, speed: int) -> Any:
    options = llvm.create_pipeline_tuning_options()
    options.speed_level, options.loop_vectorization, options.slp_vectorization = speed, speed > 0, False
    options.loop_unrolling = False  # it takes long, and lanes gain nothing by it
    return llvm.create_pass_builder(machine, options)
