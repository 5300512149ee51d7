"""Runs the steps of docs/examples/golden/workflow.yml as they are written, in a project of its own.

What is replaced: the checkout, by a copy of this source tree as facet/ and of two bundled scenes as models/; the
installation of packages, by looking that the script that it calls is there; the compiler's work, by ninja's list of it and
the program that is built already. Everything else is what a CI would do.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree


def read_steps(workflow):
    """Name to command of the steps that run something: the little of YAML that the file uses."""
    steps, name, lines = {}, None, workflow.splitlines()
    for number, line in enumerate(lines):
        if match := re.match(r"\s+- name: (.*)", line):
            name = match[1]
        if match := re.match(r"(\s+)run: (.*)", line):
            indent, command = match[1], match[2]
            if command == "|":
                block = []
                for later in lines[number + 1 :]:
                    if later.strip() and not later.startswith(indent + "  "):
                        break
                    block.append(later[len(indent) + 2 :])
                command = "\n".join(block).rstrip() + "\n"
            steps[name] = command
    return steps


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("program", type=pathlib.Path)
    arguments = parser.parse_args()
    examples = arguments.source / "docs/examples/golden"
    workflow = (examples / "workflow.yml").read_text()
    manifest = (examples / "goldens.json").read_text()
    page = (arguments.source / "docs/golden-tests.md").read_text()
    assert f"```yaml\n{workflow}```" in page, "the page shows another workflow"
    assert f"```json\n{manifest}```" in page, "the page shows another manifest"
    update = re.search(r"^    facet (check .* --update)$", page, re.MULTILINE)[1]

    steps = read_steps(workflow)
    assert list(steps) == ["Install git", "Install what facet is built from", "Build facet", "Check the pictures",
                           "Say what differs beside the change"], list(steps)

    with tempfile.TemporaryDirectory(prefix="facet-workflow-") as scratch:
        project = pathlib.Path(scratch)
        shutil.copytree(arguments.source, project / "facet", ignore=shutil.ignore_patterns("build", ".git"))
        (project / "models").mkdir()
        for scene in ("showcase.glb", "animated.glb"):
            shutil.copy(arguments.source / "assets/scenes" / scene, project / "models")
        (project / "goldens").mkdir()
        goldens = project / "goldens/goldens.json"
        goldens.write_text(manifest)

        def run(command, expected=0):
            # As the runner does: "bash -e" on a file.
            script = project / "step.sh"
            script.write_text(command)
            environment = {key: value for key, value in os.environ.items() if not key.startswith("FACET_")}
            done = subprocess.run(["bash", "-e", str(script)], cwd=project, env=environment, capture_output=True, text=True)
            if done.returncode != expected:
                sys.exit(f"exit code {done.returncode}, not {expected}:\n{command}\n{done.stdout}\n{done.stderr}")
            return done.stdout

        install = steps["Install what facet is built from"].split()
        assert os.access(project / install[0], os.X_OK), install[0]
        assert install[1:] == ["--minimal"]

        last = steps["Build facet"].rstrip()
        assert last.splitlines()[-1].startswith("cmake --build ")
        commands = run(last + " -- -t commands\n")
        assert "main.cc.o" in commands and "facet_oiio.so" in commands, "not what would be needed"
        built = project / "facet/build/release/facet"
        built.symlink_to(arguments.program.resolve())
        for path in re.findall(r"^ +(facet/build/\S+)$", workflow, re.MULTILINE):  # what the cache keeps
            folder, name = os.path.split(path)
            assert (project / folder).is_dir() and (arguments.program.parent / name).exists(), path

        check = steps["Check the pictures"]
        run(check, expected=2)  # there is no golden picture yet
        run(f"facet/build/release/facet {update}\n")
        accepted = goldens.read_bytes()
        assert (project / "goldens/showcase.png").read_bytes()[1:4] == b"PNG"
        shutil.rmtree(project / "report")
        run(check)
        assert sorted(os.listdir(project / "report")) == ["index.html", "junit.xml"]
        suite = ElementTree.parse(project / "report/junit.xml").getroot()
        assert suite.tag == "testsuites" and (suite.get("tests"), suite.get("failures")) == ("2", "0")

        # Somebody changes a setting and a scene.
        goldens.write_text(accepted.decode().replace('"still life"', '0').replace("0.4,", "0.5,"))
        assert goldens.read_bytes() != accepted
        shutil.copy(arguments.source / "assets/scenes/room.glb", project / "models/animated.glb")
        run(check, expected=2)  # the other scene has no animation
        goldens.write_bytes(accepted.replace(b'"background": "#22262c"', b'"environment-rotation": 30'))
        shutil.copy(arguments.source / "assets/scenes/animated.glb", project / "models")
        output = run(check, expected=1)
        assert "the inputs are the same" in output, output
        assert {"index.html", "junit.xml", "showcase.actual.png", "showcase.difference.png"} <= set(
            os.listdir(project / "report"))
        failures = ElementTree.parse(project / "report/junit.xml").getroot().findall(".//testcase/failure")
        assert len(failures) == 1
        said = run(steps["Say what differs beside the change"])
        assert said.startswith("::error::showcase: the film differs; ") and said.count("\n") == 1, said

        # And accepts it.
        run(f"facet/build/release/facet {update}\n")
        run(check)
    print("the workflow works as written")


if __name__ == "__main__":
    main()
