// What the program says to a command line: help, the nearest right word, the exit status.
#include "tests/app/child.hpp"

namespace gault::test {
namespace {

using CommandLine = App;
const std::string scene = (repository / "plugins/fixity/scene.yaml").string();

TEST_F(CommandLine, HelpNamesEveryCommandAndTheExitStatuses) {
    const Outcome help = gault({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    for (const char* part : {"run", "check", "list", "describe", "--log-level", "--version",
                             "Examples:", "Exit status:", "0 done", "2 wrong scene or command line",
                             "3 the run failed", "130 interrupted"})
        EXPECT_TRUE(has(help.out, part)) << part << "\n" << help.out;
}

TEST_F(CommandLine, HelpOfACommandNamesItsOptionsAndShowsExamples) {
    const std::map<std::string, Words> options{
        {"run",
         {"scene", "--set", "--output", "--force", "--quiet", "--threads", "--plugin-path", "history.csv"}},
        {"check", {"scene", "--set", "--plugin-path"}},
        {"list", {"--plugin-path"}},
        {"describe", {"name", "--plugin-path"}}};
    for (const auto& [command, parts] : options) {
        const Outcome help = gault({command, "--help"});
        EXPECT_EQ(help.status, 0);
        EXPECT_TRUE(has(help.out, "Examples:\n  gault " + command)) << help.out;
        for (const std::string& part : parts)
            EXPECT_TRUE(has(help.out, part)) << part << "\n" << help.out;
    }
}

TEST_F(CommandLine, EveryCommandOfTheHelpHasExamples) {
    const std::string help = gault({"--help"}).out;
    const std::string commands = help.substr(help.find("Subcommands:\n") + 13);
    int count = 0;
    for (const std::string& line : lines(commands.substr(1, commands.find("\n\n")))) {
        if (!line.starts_with("  ") || line[2] == ' ') continue; // a summary that goes on
        const std::string command = line.substr(2, line.find(' ', 2) - 2);
        EXPECT_TRUE(has(gault({command, "--help"}).out, "\n  gault " + command)) << command;
        ++count;
    }
    EXPECT_GE(count, 4);
}

TEST_F(CommandLine, ExamplesOfTheHelpNameScenesThatExist) {
    for (const char* command : {"", "run", "check"})
        for (const std::string& line :
             lines(gault(*command ? Words{command, "--help"} : Words{"--help"}).out))
            if (const auto begin = line.find("configs/"); begin != std::string::npos) {
                const std::string file = line.substr(begin, line.find(' ', begin) - begin);
                EXPECT_TRUE(fs::exists(repository / file)) << line;
            }
}

TEST_F(CommandLine, VersionIsOneLine) {
    const Outcome version = gault({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_TRUE(version.out.starts_with("gault ")) << version.out;
    EXPECT_EQ(lines(version.out).size(), 1u);
}

TEST_F(CommandLine, WithoutACommandListsThem) {
    EXPECT_TRUE(refusal(gault({})).starts_with(
        "a command is required; allowed: run, plot, check, plan, frontier, element, certify, new, list, describe"));
}

TEST_F(CommandLine, MistypedCommandGetsTheNearestOne) {
    EXPECT_TRUE(has(refusal(gault({"rnu", scene})), "no command 'rnu'; did you mean 'run'?"));
    EXPECT_TRUE(
        has(refusal(gault({"--log-level", "debug", "lsit"})), "no command 'lsit'; did you mean 'list'?"));
}

TEST_F(CommandLine, MistypedOptionGetsTheNearestOne) {
    EXPECT_TRUE(
        has(refusal(gault({"run", scene, "--forec"})), "no option '--forec'; did you mean '--force'?"));
    EXPECT_TRUE(
        has(refusal(gault({"run", "--theads=2", scene})), "no option '--theads'; did you mean '--threads'?"));
    EXPECT_TRUE(has(refusal(gault({"list", "--plugin_path", "x"})), "did you mean '--plugin-path'?"));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "--log-levle", "warn"})), "did you mean '--log-level'?"));
    EXPECT_TRUE(has(refusal(gault({"--versoin"})), "did you mean '--version'?"));
}

TEST_F(CommandLine, OptionBeforeItsCommandIsToldWhereItBelongs) {
    EXPECT_TRUE(has(refusal(gault({"--force", "run", scene})), "stands before its command"));
}

TEST_F(CommandLine, GlobalOptionMayStandAfterTheCommand) {
    const Outcome outcome = gault({"run", scene, "--log-level", "error"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
}

TEST_F(CommandLine, MissingValueOrWordIsNamed) {
    EXPECT_TRUE(has(refusal(gault({"run"})), "scene is required; see `gault run --help`"));
    EXPECT_TRUE(has(refusal(gault({"describe"})), "name is required"));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "--set"})), "--set: 1 required KEY=VALUE missing"));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "-o"})), "--output"));
    EXPECT_TRUE(fs::is_empty(work));
}

TEST_F(CommandLine, WordTooManyIsNamed) {
    EXPECT_TRUE(has(refusal(gault({"run", scene, "another.yaml"})), "unexpected 'another.yaml'"));
    EXPECT_TRUE(fs::is_empty(work));
}

TEST_F(CommandLine, ValueOutOfRangeSaysTheRange) {
    EXPECT_TRUE(has(refusal(gault({"run", scene, "-j", "0"})), "1 to 1024"));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "-j", "two"})), "1 to 1024"));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "--log-level", "loud"})), "debug,info,warn,error"));
}

TEST_F(CommandLine, OverrideWithoutEqualsSignShowsAnExample) {
    EXPECT_TRUE(has(refusal(gault({"run", scene, "--set", "grid.cells"})),
                    "--set grid.cells: expected KEY=VALUE, e.g. "));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "--set", "=3"})), "--set =3: expected KEY=VALUE"));
    EXPECT_TRUE(fs::is_empty(work));
}

TEST_F(CommandLine, OverrideOfAnUnknownKeyGetsTheNearestOne) {
    EXPECT_TRUE(has(refusal(gault({"run", scene, "--set", "grid.cels=[8, 8]"})), "did you mean 'cells'?"));
}

TEST_F(CommandLine, MissingSceneIsSaidSo) {
    EXPECT_EQ(refusal(gault({"run", "nothing.yaml"})), "nothing.yaml: no such file\n");
    EXPECT_EQ(refusal(gault({"check", "."})), ".: a folder, not a file\n");
    EXPECT_TRUE(fs::is_empty(work));
}

TEST_F(CommandLine, FolderThatCannotBeWrittenIsRefused) {
    EXPECT_TRUE(has(refusal(gault({"run", scene, "-o", "/dev/null/results"})),
                    "cannot write results in '/dev/null/results'"));
    EXPECT_TRUE(has(refusal(gault({"run", scene, "-o", scene})), "cannot write results in '" + scene + "'"));
}

TEST_F(CommandLine, ResultsGoToAFolderNamedAfterTheSceneUnlessTold) {
    EXPECT_EQ(gault({"run", scene}).status, 0);
    EXPECT_EQ(summary(work / "out/scene")["status"], "done");
}

TEST_F(CommandLine, QuietRunPrintsNothing) {
    const Outcome outcome = gault({"run", scene, "-q"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(CommandLine, EndOfARunSaysHowQuasiStaticItWas) {
    const Outcome outcome = gault({"run", scene, "--set", "model.solver=explicit"});
    EXPECT_TRUE(has(outcome.err, "kinetic energy at most ")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "energy error ")) << outcome.err;
    const Outcome still = gault({"run", scene, "--force", "--set", "model.solver=quasi_static"});
    EXPECT_FALSE(has(still.err, "kinetic energy")) << still.err;
    EXPECT_TRUE(has(outcome.err, "results in out/scene\n")) << outcome.err;
}

} // namespace
} // namespace gault::test
