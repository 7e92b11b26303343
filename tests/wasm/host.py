"""A host of the component: the runtime wasmtime, with functions by their names in the interface."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from wasmtime import Engine, Store
from wasmtime.component import Component, Func, Linker

from harness import Package

PACKAGE = "fmi:fmi3/{}@3.0.0"
# Value reference of the independent variable.
TIME = 2147483647
STATUSES = ("ok", "warning", "discard", "error", "fatal")
KINDS = {"Real": "float64", "Enumeration": "int64", "Boolean": "boolean"}


class Message(NamedTuple):
    """What the component told its host."""

    instance: str
    status: str
    category: str
    text: str


class Refused(Exception):
    """A call returned another status than ok."""

    def __init__(self, function: str, status: str, log: list[Message]) -> None:
        self.status, self.text = status, log[-1].text if log else ""
        super().__init__(f"{function}: {status}: {self.text}")


class Host:
    """The component, loaded: `log` has what its instances say."""

    def __init__(self, file: Path, package: Package) -> None:
        self.package, self.log = package, list[Message]()
        engine = Engine()
        self.component = Component.from_file(engine, str(file))
        self.imports = list(self.component.type.imports(engine))
        self.exports = list(self.component.type.exports(engine))
        self.store = Store(engine)
        linker = Linker(engine)
        with linker.root() as root, root.add_instance(PACKAGE.format("callbacks")) as callbacks:
            callbacks.add_func("log-message", lambda _, *said: self.log.append(Message(*said)))
            for other in ("clock-update", "lock-preemption", "unlock-preemption"):
                callbacks.add_func(other, lambda _: None)
        self.instance = linker.instantiate(self.store, self.component)
        self._functions = dict[tuple[str, str], Func]()

    def function(self, interface: str, name: str) -> Func:
        """An exported function."""
        key = (interface, name)
        if key not in self._functions:
            place = self.instance.get_export_index(self.store, PACKAGE.format(interface))
            index = self.instance.get_export_index(self.store, name, place)
            function = index and self.instance.get_func(self.store, index)
            assert function, f"{interface} has no {name}"
            self._functions[key] = function
        return self._functions[key]

    def run(self, interface: str, name: str, *arguments: Any) -> Any:
        """What an exported function returns."""
        function = self.function(interface, name)
        answer = function(self.store, *arguments)
        function.post_return(self.store)
        return answer

    def instantiate(
        self,
        interface: str,
        name: str = "ahv",
        token: str | None = None,
        *flags: Any,
        resources: str = "",
    ) -> Instance | None:
        """An instance for `co-simulation` or `model-exchange`, if the component makes one."""
        token = self.package.description.guid if token is None else token
        static = f"[static]{interface}-instance.instantiate-{interface}"
        extra = flags or ((False, False, []) if interface == "co-simulation" else ())
        made = self.run(interface, static, name, token, resources, False, False, *extra)
        return made and Instance(self, interface, made)

    def flight(self, interface: str = "co-simulation", **start: Any) -> Instance:
        """A new instance, initialised with these start values."""
        flight = self.instantiate(interface)
        assert flight, self.log
        flight.initialise(**start)
        return flight


class Instance:
    """One instance, with the names of variables; `time` is the end of the last step."""

    def __init__(self, host: Host, interface: str, resource: Any) -> None:
        self.host, self.interface, self.resource, self.time = host, interface, resource, 0.0

    def raw(self, name: str, *arguments: Any) -> Any:
        """What a method returns."""
        method = f"[method]{self.interface}-instance.{name}"
        return self.host.run(self.interface, method, self.resource, *arguments)

    def call(self, name: str, *arguments: Any) -> Any:
        """The answer of a method that has to succeed."""
        answer = self.raw(name, *arguments)
        if answer in STATUSES[1:]:
            raise Refused(name, answer, self.host.log)
        return answer

    def close(self) -> None:
        """Free the instance."""
        self.resource.drop(self.host.store)

    def set(self, **values: Any) -> None:
        """Set variables; enumerations by number."""
        for name, value in values.items():
            variable = self.host.package.variables[name]
            kind = KINDS[variable.type]
            number = {"float64": float, "int64": int, "boolean": bool}[kind](value)
            self.call(f"set-{kind}", [variable.valueReference], [number])

    def get(self, *names: str) -> np.ndarray:
        """Values of real variables."""
        return np.array(self.call("get-float64", self.host.package.references(*names)))

    def bits(self) -> bytes:
        """The bits of all real variables."""
        variables = self.host.package.variables
        return self.get(*(name for name, v in variables.items() if v.type == "Real")).tobytes()

    def initialise(
        self,
        tolerance: float | None = None,
        start: float = 0.0,
        stop: float | None = None,
        **values: Any,
    ) -> None:
        """Set start values and initialise."""
        self.set(**values)
        self.call("enter-initialization-mode", tolerance, start, stop)
        self.call("exit-initialization-mode")
        self.time = start

    def step(self, size: float) -> None:
        """One communication step."""
        answer = self.call("do-step", self.time, size, True)
        self.time += size
        assert getattr(answer, "last-successful-time") == self.time
        assert not getattr(answer, "terminate-simulation")
