"""From LLVM code to functions that Python can call, for the processor at hand."""

import ctypes
from collections.abc import Sequence
from enum import StrEnum
from functools import cache
from typing import Any

import llvmlite
from llvmlite import binding, ir


class OptimisationLevel(StrEnum):
    """How well code is compiled: in little time, or to run fast."""

    QUICK = "quick"
    FAST = "fast"


@cache
def _initialised() -> None:
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


# llvmlite fills a table of escapes when it first prints a string, and not safely for two threads.
str(ir.Constant(ir.ArrayType(ir.IntType(8), 1), bytearray(b"x")))


@cache
def processor() -> str:
    """The versions of LLVM and its binding, the processor and its features."""
    _initialised()
    llvm = ".".join(map(str, binding.llvm_version_info))
    features = binding.get_host_cpu_features().flatten()
    name = f"{binding.get_default_triple()} {binding.get_host_cpu_name()}"
    return f"{llvmlite.__version__} {llvm} {name} {features}"


def _machine(level: OptimisationLevel) -> Any:
    """A description of this processor."""
    _initialised()
    return binding.Target.from_default_triple().create_target_machine(
        cpu=binding.get_host_cpu_name(),
        features=binding.get_host_cpu_features().flatten(),
        opt=2 if level is OptimisationLevel.FAST else 0,
        codemodel="jitdefault",
    )


def object_code(text: str, level: OptimisationLevel) -> bytes:
    """A module in LLVM's assembly language, compiled."""
    machine = _machine(level)
    parsed = binding.parse_assembly(text)
    parsed.triple, parsed.data_layout = machine.triple, str(machine.target_data)
    parsed.verify()
    if level is OptimisationLevel.FAST:
        options = binding.create_pipeline_tuning_options(speed_level=1)
        passes = binding.create_pass_builder(machine, options)
        passes.getModulePassManager().run(parsed, passes)
    return bytes(machine.emit_object(parsed))


class NativeLibrary:
    """The functions of compiled code; keep it as long as they are called.

    Raises ``LookupError`` where one of the functions that it ``needs`` is missing.
    """

    def __init__(self, code: bytes, needs: Sequence[str] = ()) -> None:
        machine = _machine(OptimisationLevel.QUICK)
        empty = binding.parse_assembly("")
        empty.triple = machine.triple
        self.engine = binding.create_mcjit_compiler(empty, machine)
        self.engine.add_object_file(binding.ObjectFileRef.from_data(code))
        self.engine.finalize_object()
        self.functions: dict[str, Any] = {}
        for name in needs:
            self._address(name)

    @staticmethod
    def of(module: ir.Module, level: OptimisationLevel = OptimisationLevel.FAST) -> "NativeLibrary":
        """A module compiled."""
        return NativeLibrary(object_code(str(module), level))

    def function(self, name: str, result: Any, arguments: Sequence[Any]) -> Any:
        """A function as a callable, with ctypes types; calls release the interpreter's lock."""
        if name not in self.functions:
            self.functions[name] = ctypes.CFUNCTYPE(result, *arguments)(self._address(name))
        return self.functions[name]

    def _address(self, name: str) -> int:
        address: int = self.engine.get_function_address(name)
        if not address:
            raise LookupError(f"The compiled code holds no function {name}.")
        return address
