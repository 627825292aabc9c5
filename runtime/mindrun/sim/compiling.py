"""How the lanes are compiled: into one piece of machine code for each way in from Python.

Numba would optimise every function and make machine code of it, link it into each caller, and do all that again there,
five levels deep. Here what only compiled code calls stays as it was lowered until it is part of a way in.
"""

from collections.abc import Callable
from typing import Any

import numba
from llvmlite.binding import Linkage
from numba import _dynfunc
from numba.core.ccallback import CFunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.sigutils import normalize_signature
from numba.core.typed_passes import NativeLowering

from mindrun.sim.cache import MachineCode


class Lowered(JITCodeLibrary):  # type: ignore[misc]
    """The code of a function, and of all that it calls, before any optimisation."""

    def add_llvm_module(self, ll_module: Any) -> None:
        """Take the code of the function itself."""
        ll_module.data_layout = self._codegen._data_layout
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Take the code of what it calls."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalize_dynamic_globals()
        self._finalized = True


class Whole(JITCodeLibrary):  # type: ignore[misc]
    """The code of a way in, with that of all that it calls."""

    def _optimize_final_module(self) -> None:
        for function in self._final_module.functions:
            if function.linkage == Linkage.linkonce_odr and not function.is_declaration:
                function.linkage = "internal"  # nobody else calls it: what it is handed and does not need falls away
        super()._optimize_final_module()


@register_pass(mutates_CFG=True, analysis_only=False)
class LowerAll(NativeLowering):  # type: ignore[misc]
    """Lower a function, and make machine code of it and of all that it calls."""

    _name = "lower_all"

    def run_pass(self, state: Any) -> bool:
        """In place of numba's own."""
        state.library = Whole(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return bool(super().run_pass(state))


@register_pass(mutates_CFG=True, analysis_only=False)
class LowerOnly(NativeLowering):  # type: ignore[misc]
    """Lower a function and make no machine code of it."""

    _name = "lower_only"

    def run_pass(self, state: Any) -> bool:
        """In place of numba's own."""
        state.library = Lowered(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        super().run_pass(state)
        lowered, module = state["cr"], state.func_id.module
        # By this object others know the function: nobody can call it.
        nowhere = _dynfunc.make_function(module, state.func_id.func_name, "", 0, lowered.env, (state.library,))
        state.targetctx.insert_user_function(nowhere, lowered.fndesc, [state.library])
        state.reload_init.extend(state.library._reload_init)
        state["cr"] = lowered._replace(cfunc=nowhere)
        return True


class Outer(CompilerBase):  # type: ignore[misc]
    """Numba's compiler but for its last step."""

    lowering: type[NativeLowering] = LowerAll

    def define_pipelines(self) -> list[PassManager]:
        """Numba's passes."""
        passes = PassManager(self.lowering._name)
        for step, about in DefaultPassBuilder.define_nopython_pipeline(self.state).passes:
            passes.add_pass(self.lowering if step is NativeLowering else step, about)
        passes.finalize()
        return [passes]


class Inner(Outer):
    """The same for what only compiled code calls."""

    lowering = LowerOnly


Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]
# They own no array and make none. With `_nrt` numba would count the references of all that they are handed, at every
# call: half of the time of a tick.
OPTIONS = {"nogil": True, "error_model": "numpy", "_nrt": False}
compiled: Decorator = numba.njit(pipeline_class=Inner, no_cpython_wrapper=True, no_cfunc_wrapper=True, **OPTIONS)
inlined: Decorator = numba.njit(inline="always", **OPTIONS)


def entry(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compiled too, and alone can be called from Python; its machine code is kept."""
    dispatcher: Any = numba.njit(pipeline_class=Outer, **OPTIONS)(function)
    dispatcher._cache = _code_of(function)
    return dispatcher  # type: ignore[no-any-return]


def callback(signature: Any) -> Callable[[Callable[..., Any]], Any]:
    """A function for C, which calls its `address`; its machine code is kept."""

    def compile_it(function: Callable[..., Any]) -> Any:
        made: Any = CFunc(function, normalize_signature(signature), locals={}, options={})
        made._cache = _code_of(function)
        made.compile()
        return made

    return compile_it


def _code_of(function: Callable[..., Any]) -> MachineCode:
    return MachineCode(f"{function.__module__.rpartition('.')[2]}.{function.__name__}")
