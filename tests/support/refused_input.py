"""The base of tests of bad input: exit code 2, one sentence that says where and what was expected, nothing written."""
from program_test import ProgramTest, overrides

BASE = {"Models": "reduced", "Time/End": 1, "Output/Samples": 10}


class RefusedInputTest(ProgramTest):
    def refused(self, *arguments, fragments):
        """Runs, and nothing is left behind or changed in the scratch folder."""
        before = {name: self.content(name) for name in self.files()}
        result = self.run_program(*arguments)
        self.assert_one_sentence(result, *fragments)
        self.assertEqual({name: self.content(name) for name in self.files()}, before)
        return result.stderr

    def content(self, name):
        path = self.scratch / name
        return path.read_bytes() if path.is_file() else None

    def refused_entries(self, entries, *fragments, base=BASE):
        """The scene `base` with other entries, from the file and, alike, by --set."""
        self.scene({**base, **entries})
        message = self.refused("run", "scene.prm", fragments=("scene.prm:", *fragments))
        self.assertRegex(message, r"^error: scene\.prm:\d+: ")
        self.refused("check", "scene.prm", fragments=fragments)
        self.scene(base)
        return self.refused("run", "scene.prm", *overrides(entries), fragments=("error: --set: ", *fragments))
