"""A hash of the code that a result depends on, so that the result can tell whether it is of today's code.

fingerprint(*functions) covers the functions and every function, class and constant of tippe_core and app.model that can
be reached from them by name: through globals, imports, attributes of modules, decorators and annotations. A class is
taken whole, with its bases. Comments, docstrings, annotations, positions, and the names of files and modules do not
count; names of functions and variables do. So code may move between files, but what computes something else differs.

What it cannot see: objects whose class no reached code names, not even in an annotation, and subclasses that only the
caller names (pass these to fingerprint() as well); functions that are found by a computed name; what a module does with
an object after its definition; the versions of libraries; files of data. Nor can it see that two texts compute the
same: a renamed variable or a new wording of an error changes the hash.
"""

import ast
import functools
import hashlib
import inspect
from pathlib import Path

ROOT = Path(__file__).parent.parent
SAME = {"compiled", "kept"}
"""Decorators that change when and where something is computed, not what."""
SKIPPED = {"ctx", "kind", "type_comment", "type_params", "annotation", "returns", "simple"}
FUNCTIONS = ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda
DEFINITIONS = *FUNCTIONS, ast.ClassDef
COMPREHENSIONS = ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp


def short(text):
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def imported(statement, package):
    """(name, (module, what is imported of it or "")) of an import."""
    if isinstance(statement, ast.Import):
        for each in statement.names:
            first = each.name.split(".")[0]
            yield each.asname or first, (each.name if each.asname else first, "")
    elif isinstance(statement, ast.ImportFrom):
        above = package[: len(package) + 1 - statement.level] if statement.level else ()
        source = ".".join([*above, statement.module or ""]).strip(".")
        for each in statement.names:
            yield each.asname or each.name, (source, each.name)


def bound_in(nodes, package=()):
    """{name: its import, else None} of the names that statements bind in their own scope."""
    found, free, nodes = {}, set(), list(nodes)
    while nodes:
        node = nodes.pop()
        found |= dict(imported(node, package))
        if isinstance(node, DEFINITIONS):
            found[getattr(node, "name", "")] = None
        elif isinstance(node, COMPREHENSIONS):
            found |= {each.target.id: None for each in ast.walk(node) if isinstance(each, ast.NamedExpr)}
        else:
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                found[node.id] = None
            elif isinstance(node, ast.ExceptHandler | ast.MatchAs | ast.MatchStar):
                found[node.name or ""] = None
            elif isinstance(node, ast.Global | ast.Nonlocal):
                free |= {*node.names}
            nodes += ast.iter_child_nodes(node)
    return {name: target for name, target in found.items() if name and name not in free}


def name_of(path):
    """Of a module, by its path below a folder of imports."""
    return ".".join(part for part in Path(path).with_suffix("").parts if part != "__init__")


class Module:
    """bound: {name: [what binds it: an import, or (statement, its number in the file)]}."""

    def __init__(self, path, source):
        self.name, self.package = name_of(path), Path(path).parts[:-1]
        text = source if isinstance(source, str) else source.read_text(encoding="utf-8")
        self.tree, self.bound = ast.parse(text), {}
        for number, statement in enumerate(self.tree.body):
            for name, target in bound_in([statement], self.package).items():
                self.bound.setdefault(name, []).append(target or (statement, number))


class Code:
    """Modules, parsed when they are needed: {path below a folder of imports: its text, or the path to read}. A
    definition is (module, number of the statement, name)."""

    def __init__(self, sources):
        self.paths = {name_of(path): path for path in sources}
        self.packages = {name.split(".")[0] for name in self.paths}
        self.module = functools.cache(lambda name: Module(self.paths[name], sources[self.paths[name]]))
        self.read = functools.cache(self._read)

    @classmethod
    def of(cls, *folders, root=ROOT):
        paths = [path for folder in folders for path in sorted((root / folder).rglob("*.py"))]
        return cls({path.relative_to(root).as_posix(): path for path in paths})

    def meant(self, module, name):
        """What a global name of a module is: definitions, names of modules, and texts for what is of libraries."""
        for target in self.module(module).bound.get(name, ()):
            if isinstance(target[0], str):
                yield from self.found(*target)
            else:
                yield module, target[1], name

    def found(self, module, name):
        if module not in self.paths:
            whole = f"{module}.{name}".strip(".")
            yield whole.split(".")[-1] if module.split(".")[0] in self.packages else whole
        elif not name:
            yield self.module(module)
        elif (module, name) not in self.module(module).bound.get(name, [(module, name)]):  # a package's own module
            yield from self.meant(module, name)
        else:
            yield from self.found(f"{module}.{name}", "")

    def _read(self, key):
        module, number, _ = key
        return Reading(self, self.module(module), self.module(module).tree.body[number])

    def closure(self, starts):
        """All that is reached; what only annotations reach counts if it is a class."""
        reached, hinted, queue = set(), set(), [(key, False) for key in starts]
        while queue:
            key, hint = queue.pop()
            hint = hint and not isinstance(self.read(key).statement, ast.ClassDef)
            if key in reached or (hint and key in hinted):
                continue
            (hinted if hint else reached).add(key)
            queue += [(each, hint) for each in self.read(key).uses] + [(each, True) for each in self.read(key).hints]
        return reached

    def hash(self, starts):
        """Each definition is labelled with its text, then with the labels of what it uses, until no more differ."""
        reached, kinds = self.closure(starts), 0
        label = {key: short(self.read(key).text) for key in reached}
        while kinds < (kinds := len({*label.values()})):
            label = {key: short(" ".join([label[key], *(label[use] for use in self.read(key).uses)]))
                     for key in reached}  # fmt: skip
        return short(" ".join([*sorted(label[key] for key in starts), "of", *sorted({*label.values()})]))


class Reading:
    """text: a statement without what does not count; uses, hints: the definitions it names, those in annotations."""

    def __init__(self, code, module, statement):
        self.code, self.module, self.statement = code, module, statement
        self.uses, self.hints, self._scopes = [], [], []
        self.text = self._spelled(statement)

    def _spelled(self, node):
        if isinstance(node, list):
            return f"[{' '.join(map(self._spelled, node))}]"
        if not isinstance(node, ast.AST):
            return repr(node)
        if isinstance(node, ast.Import | ast.ImportFrom | ast.Pass) or self._is_text(node):
            return ""
        self._hint(getattr(node, "annotation", None), getattr(node, "returns", None))
        if isinstance(node, ast.Name | ast.Attribute) and (meant := self._meant(node)) is not None:
            return self._named(meant)
        if isinstance(node, FUNCTIONS):
            return self._function(node)
        if isinstance(node, COMPREHENSIONS):
            return self._comprehension(node)
        return self._fields(node)

    def _fields(self, node, but=()):
        kind = "Assign" if isinstance(node, ast.AnnAssign) else type(node).__name__
        fields = ((name, value) for name, value in ast.iter_fields(node) if value not in (None, []))
        return f"({kind} {' '.join(self._spelled(v) for name, v in fields if name not in SKIPPED and name not in but)})"

    @staticmethod
    def _is_text(node):
        """A docstring, or one below a constant."""
        return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)

    def _function(self, node):
        decorators = [each for each in getattr(node, "decorator_list", ()) if self._last(each) not in SAME]
        outside = self._spelled(decorators) + self._spelled([*node.args.defaults, *filter(None, node.args.kw_defaults)])
        named = [arg.arg for arg in ast.walk(node.args) if isinstance(arg, ast.arg)]
        body = node.body if isinstance(node.body, list) else [node.body]
        for arg in ast.walk(node.args):
            self._hint(getattr(arg, "annotation", None))
        self._scopes.append(bound_in(body, self.module.package) | dict.fromkeys(named))
        counts = [len(each) for each in (node.args.posonlyargs, node.args.args, node.args.kwonlyargs)]
        inside = self._fields(node, but=("decorator_list", "args"))
        self._scopes.pop()
        star = bool(node.args.vararg), bool(node.args.kwarg), [default is None for default in node.args.kw_defaults]
        return f"{outside} {named} {counts} {star} {inside}"

    def _comprehension(self, node):
        outside = self._spelled(node.generators[0].iter)
        self._scopes.append(bound_in([each.target for each in node.generators]))
        inside = self._fields(node)
        self._scopes.pop()
        return f"{outside} {inside}"

    def _hint(self, *annotations):
        uses, self.uses = self.uses, self.hints
        for annotation in filter(None, annotations):
            self._spelled(annotation)
            for each in ast.walk(annotation):
                if isinstance(each, ast.Constant) and isinstance(each.value, str):
                    self._spelled(ast.parse(each.value, mode="eval").body)
        self.uses = uses

    def _last(self, decorator):
        while isinstance(decorator, ast.Call):
            decorator = decorator.func
        return getattr(decorator, "id", getattr(decorator, "attr", ""))

    def _meant(self, node):
        """What a name, or an attribute of a module, is: a list of definitions, modules and texts; None for others."""
        if isinstance(node, ast.Attribute):
            owner = self._meant(node.value) if isinstance(node.value, ast.Name | ast.Attribute) else None
            modules = [each for each in owner or () if isinstance(each, Module)]
            return [what for each in modules for what in self.code.found(each.name, node.attr)] if modules else None
        for scope in reversed(self._scopes):
            if node.id in scope:
                return [*self.code.found(*scope[node.id])] if scope[node.id] else None
        return [*self.code.meant(self.module.name, node.id)] or None

    def _named(self, meant):
        words = []
        for each in meant:
            if isinstance(each, str):
                words.append(each)
            elif isinstance(each, Module):
                self.uses += [use for name in each.bound for use in self.code.meant(each.name, name)
                              if isinstance(use, tuple)]  # fmt: skip
            else:
                self.uses.append(each)
                words.append(each[2])
        return f"<{' '.join(words)}>"


@functools.cache
def core():
    return Code.of("tippe_core", "app/model")


def key_of(function, code):
    """The definitions that a function, class, method or compiled function is, or is part of."""
    function = inspect.unwrap(function)
    name = function.__qualname__.split(".")[0]
    keys = [key for key in code.meant(function.__module__, name) if isinstance(key, tuple)]
    assert keys, f"{function.__module__}.{name} is not among the files"
    return keys


def fingerprint(*functions, code=None):
    """Of functions and classes of tippe_core and app.model, or of other code; twelve hexadecimal digits."""
    code = code or core()
    return code.hash([key for function in functions for key in key_of(function, code)])
