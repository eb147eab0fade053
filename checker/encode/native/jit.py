"""Compiling LLVM code in memory for the processor at hand."""

import ctypes
from collections.abc import Sequence
from functools import cache
from typing import Any

from llvmlite import binding, ir


@cache
def _initialised() -> None:
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


# llvmlite fills a table of escapes when it first prints a string, and not safely for two threads.
str(ir.Constant(ir.ArrayType(ir.IntType(8), 1), bytearray(b"x")))


def _machine() -> Any:
    """A description of this processor; the engine that is made with it owns it."""
    _initialised()
    features = binding.get_host_cpu_features().flatten()
    target = binding.Target.from_default_triple()
    return target.create_target_machine(cpu=binding.get_host_cpu_name(), features=features, opt=2)


class Library:
    """The compiled functions of a module; keep it as long as they are called."""

    def __init__(self, module: ir.Module) -> None:
        machine = _machine()
        module.triple, module.data_layout = machine.triple, str(machine.target_data)
        parsed = binding.parse_assembly(str(module))
        parsed.verify()
        _optimise(parsed, machine)
        self.engine = binding.create_mcjit_compiler(parsed, machine)
        self.engine.finalize_object()
        self.functions: dict[str, Any] = {}

    def function(self, name: str, result: Any, arguments: Sequence[Any]) -> Any:
        """A function as a callable, with ctypes types; calls release the interpreter's lock."""
        if name not in self.functions:
            address = self.engine.get_function_address(name)
            self.functions[name] = ctypes.CFUNCTYPE(result, *arguments)(address)
        return self.functions[name]


def _optimise(parsed: Any, machine: Any) -> None:
    options = binding.create_pipeline_tuning_options(speed_level=1)
    passes = binding.create_pass_builder(machine, options)
    passes.getModulePassManager().run(parsed, passes)
