"""Holds a JUnit report against the rules that build servers read it by (the schemas of Ant, Jenkins and Surefire
agree on these): elements and their order, required attributes, numbers that are numbers, counts that count.

    junit_rules.py REPORT
"""
import sys
import xml.etree.ElementTree as tree

ATTRIBUTES = {
    "testsuites": ({"name", "tests", "failures", "errors"}, {"time", "disabled"}),
    "testsuite": ({"name", "tests", "failures", "errors", "skipped", "time"},
                  {"timestamp", "hostname", "id", "package", "file"}),
    "testcase": ({"name", "classname", "time"}, {"file", "line", "status"}),
    "failure": ({"message", "type"}, set()),
    "error": ({"message", "type"}, set()),
    "skipped": (set(), {"message"}),
}
CHILDREN = {
    "testsuites": {"testsuite"},
    "testsuite": {"testcase", "properties", "system-out", "system-err"},
    "testcase": {"failure", "error", "skipped", "system-out", "system-err"},
}
COUNTS = {"tests", "failures", "errors", "skipped", "disabled"}

wrong = []


def check_element(element, path):
    required, allowed = ATTRIBUTES.get(element.tag, (None, None))
    if required is None:
        return wrong.append(f"{path}: no such element")
    for name in required - set(element.keys()):
        wrong.append(f"{path}: lacks `{name}`")
    for name in set(element.keys()) - required - allowed:
        wrong.append(f"{path}: `{name}` is none of its attributes")
    for name, value in element.items():
        if name in COUNTS and not (value.isdigit() and value.isascii()):
            wrong.append(f"{path}: {name}=\"{value}\" is no count")
        if name == "time" and (not all(c in "0123456789." for c in value) or float(value) < 0):
            wrong.append(f"{path}: time=\"{value}\" are no seconds")
    if element.tag in CHILDREN and element.text and element.text.strip():
        wrong.append(f"{path}: text between its elements")
    for child in element:
        if child.tag not in CHILDREN.get(element.tag, set()):
            wrong.append(f"{path}: `{child.tag}` may not stand here")
        check_element(child, f"{path}/{child.tag}[{child.get('name', '')}]")


def check_counts(element):
    cases = list(element.iter("testcase"))
    found = {"tests": len(cases)}
    for count, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        found[count] = sum(1 for case in cases if case.find(tag) is not None)
    for name, number in found.items():
        if name in element.keys() and int(element.get(name)) != number:
            wrong.append(f"{element.tag} `{element.get('name')}`: {name}={element.get(name)}, there are {number}")


def check_names(root):
    seen = set()
    for case in root.iter("testcase"):
        key = case.get("classname"), case.get("name")
        if key in seen:
            wrong.append(f"two cases are called {key}")
        seen.add(key)


root = tree.parse(sys.argv[1]).getroot()
if root.tag != "testsuites":
    wrong.append(f"the root is `{root.tag}`, not `testsuites`")
check_element(root, root.tag)
for suite in [root, *root.iter("testsuite")]:
    check_counts(suite)
check_names(root)
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
