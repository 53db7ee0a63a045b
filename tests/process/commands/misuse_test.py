"""Options given in a way that no command can mean: the option is named, nothing is done.

Commands and options are the program's own (amb manual), so that a new one is tested when it is added.
"""

import re
import unittest

from command import USAGE, CommandTest, amb


class Misuse(CommandTest):
    def options_with_value(self):
        """(command, option) so that each command and each option with a value of the manual is met."""
        pages = amb(self.folder, "manual", "--markdown").stdout
        found = [(command, option)
                 for command, page in re.findall(r"\n## amb ([a-z -]+)\n(.*?)(?=\n## |\Z)", pages, re.S)
                 for option in re.findall(r"^\| `(--[a-z0-9-]+)(?:,--[a-z0-9-]+)* [A-Z]", page, re.M)]
        self.assertGreater(len(found), 20, "the manual is no longer read as it is written")
        commands = {pair[0]: pair for pair in found}
        options = {pair[1]: pair for pair in found}  # an option means the same wherever it is
        return sorted({*commands.values(), *options.values()})

    def test_an_option_without_its_value_is_named_and_nothing_is_written(self):
        for command, option in self.options_with_value():
            with self.subTest(command=command, option=option):
                message = self.refuse(USAGE, option, *command.split(), option)
                self.assertIn(f"see amb {command} --help", message)
                self.assertEqual(len(message.splitlines()), 1, message)


if __name__ == "__main__":
    unittest.main()
