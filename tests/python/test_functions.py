# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions are those of the table of verbs, with its options as keywords; what they refuse is an exception."""
import inspect
import json
import pickle
import re
import typing
import unittest
import warnings

from support import HOUSE, SOURCE, InFolder, command

import standpoint


def options_on_the_page() -> dict:
    """Verb -> its options, read from docs/reference/verbs.md, which another program writes."""
    page = (SOURCE / "docs/reference/verbs.md").read_text(encoding="utf-8")
    found = {}
    for part in re.split(r"^## ", page, flags=re.M)[1:]:
        rows = re.findall(r"^\| `(?:-\w, )?(?:--)?([\w-]+)(?:\.\.\.)?` \|(?:[^|\\]|\\.)*\| (.*?) \|", part, flags=re.M)
        if rows:
            found[part.split("\n", 1)[0].strip()] = dict(rows)
    return found


class Functions(InFolder):
    def test_every_verb_and_option_of_the_reference_page_is_a_function_and_a_keyword(self):
        page = options_on_the_page()
        self.assertGreater(len(page), 30)
        for verb, options in page.items():
            name = {"import": "import_"}.get(verb, verb)
            keywords = inspect.signature(getattr(standpoint, name)).parameters
            spelled = {option.replace("-", "_").rstrip("_") for option in options}
            self.assertEqual(spelled, {k.rstrip("_") for k in keywords} - {"project", "allow_loss", "progress"}, verb)
            for option, default in options.items():
                keyword = next(p for k, p in keywords.items() if k.rstrip("_") == option.replace("-", "_"))
                self.assertEqual(keyword.default is inspect.Parameter.empty, default == "required", (verb, option))

    def test_a_function_has_types_and_help(self):
        function = standpoint.scan
        self.assertEqual(function.__name__, "scan")
        self.assertEqual(function.__module__, "standpoint")
        types = typing.get_type_hints(function)
        self.assertIs(types["return"], standpoint.Answer)
        self.assertEqual((types["seed"], types["truth"]), (int, bool))
        self.assertEqual(types["quality"], typing.Literal["preview", "default", "reference"])
        for words in ("Scan from the stations", "instrument : ", "seed : int, optional", "default 1", "Answer"):
            self.assertIn(words, function.__doc__)
        self.assertEqual(str(inspect.signature(standpoint.convert)).count("in_"), 1)

    def test_a_method_of_a_project_has_the_keywords_of_the_function(self):
        for name in ("scan", "station", "assess"):
            of_function = list(inspect.signature(getattr(standpoint, name)).parameters)
            of_method = list(inspect.signature(getattr(standpoint.Project, name)).parameters)
            self.assertEqual(of_function[1:], of_method[1:])
        self.assertFalse(hasattr(standpoint.Project, "convert"))

    def test_no_verb_has_an_option_that_hides_a_keyword_of_the_module(self):
        for verb in standpoint._verbs.TABLE:
            names = [p["name"] for p in verb["parameters"]]
            self.assertFalse({"progress", "allow-loss", "project", "self"} & set(names), verb["name"])

    def test_an_answer_is_what_the_command_line_prints(self):
        said = json.loads(command("instruments", "--json").stdout)
        answer = standpoint.instruments()
        self.assertEqual({**answer, "seconds": 0}, {**said, "seconds": 0})
        self.assertIsInstance(answer, dict)

    def test_an_answer_has_description_and_issues(self):
        answer = standpoint.import_([HOUSE], output="house")
        self.assertIn("Imported", answer.description)
        self.assertEqual([issue._asdict() for issue in answer.issues], answer["issues"])

    def test_values_of_python_are_taken_for_words(self):
        import numpy as np

        standpoint.import_(HOUSE, output="house")
        answer = standpoint.station("house", add="S1", on=np.array([4.3, 1.6]), height=np.float32(1.5))
        self.assertEqual([row["at"] for row in answer["stations"]], [[4.3, 1.6, 1.5]])
        with self.assertRaises(standpoint.UsageError) as caught:
            standpoint.scan("house", instrument="leica-rtc360", set={"double_scan": True, "resolution": "1 furlong"},
                            output="x.e57")
        self.assertIn("resolution", str(caught.exception))

    def test_what_is_refused_has_kind_place_and_message(self):
        with self.assertRaises(standpoint.UsageError) as caught:
            standpoint.optimize("nowhere", budget=-1)
        self.assertEqual(caught.exception.kind, "usage")
        self.assertIn("must be a whole number", caught.exception.message)
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaises(standpoint.FileSystemError) as caught:
            standpoint.assess("nowhere")
        self.assertIn("not a Standpoint project", str(caught.exception))
        self.assertEqual(caught.exception.place, "nowhere")
        self.assertIsInstance(caught.exception, OSError)
        with open("broken.ifc", "w", encoding="utf-8") as file:
            file.write("no model")
        with self.assertRaises(standpoint.UnusableError) as caught:
            standpoint.import_("broken.ifc", output="p")
        self.assertIn("broken.ifc", caught.exception.place)
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((again.kind, again.place, str(again)), ("unusable", caught.exception.place,
                                                                 str(caught.exception)))

    def test_wrong_calls_are_refused_as_python_does(self):
        for call in (lambda: standpoint.scan(), lambda: standpoint.scan("p", output="x"),
                     lambda: standpoint.scan("p", instrument="i", output="o", speed=3)):
            self.assertRaises(TypeError, call)
        with self.assertRaises(standpoint.UsageError) as caught:
            standpoint.scan("p", instrument="i", output="o", seed=1.5)
        self.assertEqual(caught.exception.place, "seed")
        with self.assertRaises(standpoint.UsageError):
            standpoint.optimize("p", max_deviation=float("nan"))

    def test_losses_are_warned_of_unless_they_are_known(self):
        with open("lines.obj", "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            answer = standpoint.import_("lines.obj", output="p")
        self.assertTrue(answer.losses)
        self.assertEqual([w.category for w in caught], [standpoint.LossWarning])
        self.assertEqual(caught[0].filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            standpoint.import_("lines.obj", output="q", allow_loss=True)

    def test_the_data_is_found_from_the_module(self):
        self.assertTrue(standpoint.instruments()["instruments"])


if __name__ == "__main__":
    unittest.main()
