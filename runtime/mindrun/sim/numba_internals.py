"""The internals of numba, held against numba 0.63 and 0.68 (`versions`).

With them a function is compiled into one piece of machine code with all that it calls, called from C, kept and taken
back; what else is used of numba is in its documentation, above all `numba.extending`.
"""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite.binding import Linkage, ModulePassManager, ValueRef, create_new_module_pass_manager
from numba import _dynfunc
from numba.core.analysis import compute_cfg_from_blocks
from numba.core.ccallback import CFunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, CompileResult, DefaultPassBuilder
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature
from numba.core.typed_passes import NativeLowering

COLLECTION_OBJECTS = 100_000  # made between two looks for garbage, while numba compiles; Python 3.11 looks after 700
LONG_INSTRUCTIONS = 300  # of LLVM, as a function is lowered; from 60 on small batches take longer


class LoweredCode(JITCodeLibrary):  # type: ignore[misc]
    """The code of a function, and of all that it calls, before any optimisation."""

    def add_llvm_module(self, ll_module: Any) -> None:
        """Add the code of the function itself."""
        ll_module.data_layout = self._codegen._data_layout
        without_variables_in_memory(ll_module, self._codegen, create_new_module_pass_manager())  # once, not per caller
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Add the code of the functions that it calls."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalize_dynamic_globals()
        self._finalized = True


class WholeCode(JITCodeLibrary):  # type: ignore[misc]
    """The code of a way in, with that of all that it calls."""

    def _optimize_final_module(self) -> None:
        for function in self._final_module.functions:
            if function.linkage == Linkage.linkonce_odr and not function.is_declaration:
                function.linkage = "internal"  # nobody else calls it: what it is handed and does not need falls away
        # Numba prunes reference counts between two passes, and turns loops round before; there are none here, and LLVM
        # does better with variables out of memory (docs/decisions/whole-ticks-compiled.md).
        inlining, _ = self._codegen._module_pass_manager(opt=0, loop_vectorize=False)
        without_variables_in_memory(self._final_module, self._codegen, inlining)
        builder = self._codegen._pass_builder()
        builder._pto.loop_unrolling = False  # it takes long, and lanes gain nothing by it
        builder.getModulePassManager().run(self._final_module, builder)


def without_variables_in_memory(module: Any, codegen: Any, passes: ModulePassManager) -> None:
    """Let `passes` go over a module, and then take variables out of memory: callers have less to optimise."""
    passes.add_sroa_pass()
    passes.add_instruction_combine_pass()
    passes.add_simplify_cfg_pass()
    passes.run(module, codegen._pass_builder(opt=0, loop_vectorize=False))


def keep_apart(function: ValueRef) -> None:
    """Forbid LLVM to inline a long function: called once, it would be inlined however long its caller gets.

    Meant for functions that loop: a call of these costs nothing that can be measured.
    """
    if sum(1 for block in function.blocks for _ in block.instructions) >= LONG_INSTRUCTIONS:
        function.add_function_attribute("noinline")


@register_pass(mutates_CFG=True, analysis_only=False)
class LowerAll(NativeLowering):  # type: ignore[misc]
    """Lower a function, and make machine code of it and of all that it calls."""

    _name = "lower_all"

    def run_pass(self, state: Any) -> bool:
        """Lower the function into WholeCode."""
        state.library = WholeCode(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return bool(super().run_pass(state))


@register_pass(mutates_CFG=True, analysis_only=False)
class LowerOnly(NativeLowering):  # type: ignore[misc]
    """Lower a function and make no machine code of it."""

    _name = "lower_only"

    def run_pass(self, state: Any) -> bool:
        """Lower the function into LoweredCode, known to its callers by an object that nobody can call."""
        state.library = LoweredCode(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        super().run_pass(state)
        lowered, module = state["cr"], state.func_id.module
        if not state.flags.forceinline and compute_cfg_from_blocks(state.func_ir.blocks).loops():
            keep_apart(state.library._final_module.get_function(lowered.fndesc.llvm_func_name))
        # By this object others know the function: nobody can call it.
        nowhere = _dynfunc.make_function(module, state.func_id.func_name, "", 0, lowered.env, (state.library,))
        state.targetctx.insert_user_function(nowhere, lowered.fndesc, [state.library])
        state.reload_init.extend(state.library._reload_init)
        state["cr"] = lowered._replace(cfunc=nowhere)
        return True


class EntryCompiler(CompilerBase):  # type: ignore[misc]
    """Numba's compiler of a way in from Python, whose last step is `lowering`."""

    lowering: type[NativeLowering] = LowerAll

    def define_pipelines(self) -> list[PassManager]:
        """The passes of numba, with `lowering` in place of its last one."""
        passes = PassManager(self.lowering._name)
        for step, about in DefaultPassBuilder.define_nopython_pipeline(self.state).passes:
            passes.add_pass(self.lowering if step is NativeLowering else step, about)
        passes.finalize()
        return [passes]


class InnerCompiler(EntryCompiler):
    """Numba's compiler of a function that only compiled code calls."""

    lowering = LowerOnly


@contextmanager
def rare_collections() -> Iterator[None]:
    """A context of rare garbage collections: compiling makes millions of objects, most of them needed until its end."""
    before = gc.get_threshold()
    gc.set_threshold(COLLECTION_OBJECTS, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)


def keep_code(dispatcher: Any, code: Any) -> None:
    """Let a compiled function take its machine code from `code`, and be compiled by one process at a time."""
    dispatcher._cache = code
    find_or_compile = dispatcher.compile

    def compile_exclusively(signature: Any) -> Any:
        # Numba's lock first: who compiles a caller has it already when the turn of another way in comes.
        with global_compiler_lock, code.exclusive(signature, dispatcher.targetctx), rare_collections():
            return find_or_compile(signature)

    dispatcher.compile = compile_exclusively


def code_of(dispatcher: Any) -> Any:
    """The cache of a compiled function's machine code, as `keep_code` has set it."""
    return dispatcher._cache


def callback_of(function: Callable[..., Any], signature: Any, code: Any) -> Any:
    """A function for C, which calls its `address`."""
    made: Any = CFunc(function, normalize_signature(signature), locals={}, options={})
    made._cache = code
    with global_compiler_lock, code.exclusive(made._sig, made._targetdescr.target_context), rare_collections():
        made.compile()
    return made


def made_for(codegen: Any) -> tuple[str, str, str]:
    """The target of a code generator: its triple, the processor and its features."""
    triple, processor, features = codegen.magic_tuple()
    return triple, processor, features


def packed(compiled: CompileResult) -> bytes:
    """A compiled function's machine code as bytes."""
    return bytes(dumps(compiled._reduce()))


def unpacked(reduced: Any, target_context: Any) -> CompileResult:
    """The machine code that `packed` has made bytes of, given those unpickled."""
    return CompileResult._rebuild(target_context, *reduced)
