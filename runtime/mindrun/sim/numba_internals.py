"""The internals of numba, held against numba 0.63 and 0.68 (`versions`).

With them a function is lowered with all that it calls, into one module for LLVM; what else is used of numba is in its
documentation, above all `numba.extending`.
"""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite.binding import parse_assembly
from numba import _dynfunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.typed_passes import NativeLowering

from mindrun.sim.machine_code import without_variables_in_memory

COLLECTION_OBJECTS = 100_000  # made between two looks for garbage, while numba compiles; Python 3.11 looks after 700


class LoweredCode(JITCodeLibrary):  # type: ignore[misc]
    """The code of a function, and of all that it calls, before any optimisation."""

    def add_llvm_module(self, ll_module: Any) -> None:
        """Add the code of the function itself."""
        ll_module.data_layout = self._codegen._data_layout
        builder = self._codegen._pass_builder(opt=0, loop_vectorize=False)
        without_variables_in_memory(ll_module, builder)  # once, not once for each caller
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Add the code of the functions that it calls."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalize_dynamic_globals()
        self._finalized = True


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
        # By this object others know the function: nobody can call it.
        nowhere = _dynfunc.make_function(module, state.func_id.func_name, "", 0, lowered.env, (state.library,))
        state.targetctx.insert_user_function(nowhere, lowered.fndesc, [state.library])
        state["cr"] = lowered._replace(cfunc=nowhere)
        return True


class InnerCompiler(CompilerBase):  # type: ignore[misc]
    """Numba's compiler of a function that only compiled code calls."""

    def define_pipelines(self) -> list[PassManager]:
        """The passes of numba, with LowerOnly in place of its last one."""
        passes = PassManager(LowerOnly._name)
        for step, about in DefaultPassBuilder.define_nopython_pipeline(self.state).passes:
            passes.add_pass(LowerOnly if step is NativeLowering else step, about)
        passes.finalize()
        return [passes]


@contextmanager
def rare_collections() -> Iterator[None]:
    """A context of rare garbage collections: compiling makes millions of objects, most of them needed until its end."""
    before = gc.get_threshold()
    gc.set_threshold(COLLECTION_OBJECTS, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)


def lowered(function: Any, signature: Any, add: Callable[[Any, Any, Any], None]) -> Any:
    """The module of a function of numba's and of all that it calls, before any optimisation.

    `add` may add to it: it is given numba's context, a module of llvmlite.ir, and what numba knows of the function.
    """
    with global_compiler_lock:
        function.compile(signature)
        (compiled,) = (each for args, each in function.overloads.items() if args == signature.args)
        context, library = function.targetctx, compiled.library
        whole, more = library._get_module_for_linking().clone(), context.create_module("for C")
        add(context, more, compiled.fndesc)
        whole.link_in(parse_assembly(str(more)))
        return whole
