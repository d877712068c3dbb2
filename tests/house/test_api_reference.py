"""The API page is what the code says, and the docstrings it is made of are complete."""

import ast
import doctest
import inspect
import re
import sys
import textwrap

import docstring_parser
import pytest

import sunwidget as sw


@pytest.fixture(scope="module")
def reference(root):
    sys.path.insert(0, str(root / "scripts"))
    try:
        import api_reference
    finally:
        sys.path.pop(0)
    return api_reference


def callables():
    """Yield name and function or class of all that is public, methods of classes included."""
    for name in sw.__all__:
        value = getattr(sw, name)
        if inspect.isfunction(value):
            yield name, value
        elif inspect.isclass(value):
            yield name, value
            foreign = {
                own
                for base in value.__mro__
                if not base.__module__.startswith("sunwidget")
                for own in vars(base)
            }
            for own, member in inspect.getmembers_static(value):
                function = getattr(member, "__func__", member)
                if inspect.isfunction(function) and own[0] != "_" and own not in foreign:
                    yield f"{name}.{own}", function


PUBLIC = dict(callables())
FUNCTIONS = {name: value for name, value in PUBLIC.items() if inspect.isfunction(value)}
MADE_BY_CALLING = {
    name: value
    for name, value in PUBLIC.items()
    if not (inspect.isclass(value) and issubclass(value, Exception))
    and "Made by" not in inspect.getdoc(value)
}


def parsed(value):
    style = docstring_parser.DocstringStyle.NUMPYDOC
    return docstring_parser.parse(inspect.getdoc(value), style)


def test_the_api_page_is_what_the_docstrings_say(root, reference):
    page = (root / "docs" / "guide" / "api.md").read_text("utf-8")
    assert page == reference.page(), "run: python scripts/api_reference.py"


def test_every_public_name_is_in_one_group_of_the_page(reference):
    listed = [name for group in reference.GROUPS.values() for name in group]
    assert sorted(listed) == sorted(set(sw.__all__) - {"__version__"})


def test_a_docstring_begins_with_one_sentence_on_one_line():
    for name, value in PUBLIC.items():
        first, *rest = inspect.getdoc(value).splitlines()
        assert first.endswith("."), name
        assert not rest or not rest[0], name


def test_a_docstring_tells_of_every_parameter_and_of_no_other():
    for name, value in MADE_BY_CALLING.items():
        doc = parsed(value)
        told = {part.strip(" *") for p in doc.params for part in p.arg_name.split(",")}
        parameters = inspect.signature(value).parameters
        names = set(parameters) - {"self", "cls"}
        in_the_text = {part for part in names if f"``{part}``" in inspect.getdoc(value)}
        assert names <= told | in_the_text, name
        if not any(p.kind is p.VAR_KEYWORD for p in parameters.values()):
            attributes = {p.arg_name for p in doc.params if p.args[0] == "attribute"}
            assert told - attributes <= names, name


def test_a_docstring_tells_what_is_returned():
    for name, function in FUNCTIONS.items():
        if inspect.signature(function).return_annotation != "None":
            in_the_text = re.search(r"\b[Rr]eturn(s|ed)?\b", inspect.getdoc(function))
            assert in_the_text if "." in name else parsed(function).returns, name


def test_a_docstring_tells_of_every_error_that_is_raised_at_once():
    for name, function in FUNCTIONS.items():
        tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
        raised = {
            node.exc.func.id
            for node in ast.walk(tree)
            if isinstance(node, ast.Raise)
            and isinstance(node.exc, ast.Call)
            and isinstance(node.exc.func, ast.Name)
        }
        assert all(error in inspect.getdoc(function) for error in raised), (name, raised)


def test_examples_in_docstrings_compile():
    parser = doctest.DocTestParser()
    examples = {name: parser.get_examples(inspect.getdoc(PUBLIC[name])) for name in PUBLIC}
    assert sum(map(len, examples.values())) > 20
    for name, found in examples.items():
        for example in found:
            compile(example.source, name, "exec")
            for used in re.findall(r"\bsw\.(\w+)", example.source):
                assert hasattr(sw, used), (name, used)
