"""The changes that mutants.py tries: of each sign and each factor of a statement."""

import ast

# Iterations and tests of convergence: a wrong step there is slow or refused, and no formula of the motion.
CONTROL = {"solve", "bisect", "zero", "enclose", "least", "resolved", "harmonics", "length", "first_below", "accept",
           "error", "factor"}  # fmt: skip


def sites(tree):
    """(statement, kind, change): change() alters the tree and returns what undoes it."""
    for function in ast.walk(tree):
        if not isinstance(function, ast.FunctionDef) or function.name in CONTROL or function.name.startswith("__"):
            continue
        for statement in function.body:
            for inner in ast.walk(statement):
                if isinstance(inner, ast.FunctionDef) or not isinstance(inner, ast.stmt):
                    continue
                yield from changes(inner)


def changes(statement):
    nodes = [statement]
    while nodes:
        node = nodes.pop()
        nodes += [child for child in ast.iter_child_nodes(node) if not isinstance(child, ast.stmt)]
        if isinstance(node, ast.Subscript):
            nodes.remove(node.slice)  # an index is not a factor
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("range", "TopError", "len"):
            nodes = [n for n in nodes if n not in node.args]
        if isinstance(node, ast.BinOp) and not any(map(is_text, (node.left, node.right))):
            other = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}.get(type(node.op))
            if other:
                kind = "sign" if other in (ast.Add, ast.Sub) else "factor"
                yield statement, kind, node, "op", other()
            if isinstance(node.op, ast.Pow) and isinstance(node.right, ast.Constant):
                yield statement, "factor", node.right, "value", node.right.value + 1
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            yield statement, "sign", node, "op", ast.UAdd()


def is_text(node):
    """A text or a list, that is no number."""
    return isinstance(node, ast.JoinedStr | ast.List | ast.Tuple) or isinstance(getattr(node, "value", None), str)
