// SPDX-License-Identifier: BSD-3-Clause
#include "app/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <string_view>
#include <utility>

#include "app/version.hpp"

namespace engrane::app {

namespace {

constexpr std::array petsc_prefixes{"-snes_", "-ksp_",   "-pc_",     "-mat_",     "-vec_",        "-log_",
                                    "-info",  "-malloc", "-memory_", "-options_", "-malloc_dump", "-on_error_"};

bool is_petsc_option(std::string_view word) {
  return std::any_of(petsc_prefixes.begin(), petsc_prefixes.end(), [&](std::string_view p) { return word.starts_with(p); });
}

/// The command line without PETSc's options and their values, in reverse order as CLI11 requires.
std::vector<std::string> own_words(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (!is_petsc_option(word)) {
      words.emplace_back(word);
      continue;
    }
    // the next word is the option's value, unless it is another option or clearly a deck
    if (i + 1 == argc) continue;
    const std::string_view next = argv[i + 1];
    const bool number =
        next.size() > 1 && next[0] == '-' && (std::isdigit(static_cast<unsigned char>(next[1])) || next[1] == '.');
    if ((next[0] != '-' || number) && !next.ends_with(".dat")) ++i;
  }
  std::reverse(words.begin(), words.end());
  return words;
}

/// Adds NAME=VALUE, with or without the slash of ABRE.
void add_definition(Options& options, const std::string& text) {
  const std::size_t sign = text.find('=');
  const bool slash = text.starts_with('/');
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
  if (sign == std::string::npos || sign == (slash ? 1U : 0U) || std::any_of(text.begin(), text.end(), control))
    throw CLI::ValidationError("-D " + text, "takes the name of an abbreviation, = and its text: -D RADIUS=0.25");
  options.wishes.overrides.definitions[(slash ? "" : "/") + text.substr(0, sign)] = text.substr(sign + 1);
}

/// Refuses what reads as a number but is no time: nan, inf and 1e999.
const CLI::Validator finite(
    [](const std::string& text) {
      double value = 0;
      const bool number = CLI::detail::lexical_cast(text, value);
      return number && !std::isfinite(value) ? "takes a finite number, not " + text : std::string();
    },
    "");

/// Reports decks that would write the same files.
void check_prefixes(const Options& options) {
  if (options.decks.size() < 2) return;
  if (!options.restart.empty()) throw CLI::ValidationError("--restart", "continues one run, not several decks");
  std::map<std::string, std::string> writers;
  for (const std::string& deck : options.decks) {
    const std::string prefix = results_prefix(options, deck);
    const auto [other, fresh] = writers.try_emplace(prefix, deck);
    if (fresh) continue;
    if (prefix == options.prefix)
      throw CLI::ValidationError("-o " + prefix, "is the name of one result; several decks need a folder, -o " + prefix + "/");
    throw CLI::ValidationError("deck", other->second + " and " + deck + " would both write " + prefix + ".h5");
  }
}

/// What the command line may say, and the options that it fills in.
class Grammar {
 public:
  explicit Grammar(Options& options) : options_(options) {
    app.name("engrane");
    app.footer(
        "Exit status: 0 fine, 1 the deck or the command is wrong or files cannot be written, and nothing was solved, 2 the "
        "solution\n"
        "failed, 3 a fault of the program, 4 a .CHK failed, 139 a user routine crashed (128 and the signal)\n"
        "or ended the program.\n"
        "PETSc's options (-snes_monitor, -ksp_view, -mat_mumps_icntl_14 80, -log_view ...) reach PETSc unchanged.\n"
        "Under MPI: mpiexec -n 2 engrane deck.dat");
    app.set_version_flag("--version", std::string("engrane ") + version);
    add_run();
    add_tasks();
    app.require_subcommand(0, 1);
    usage_ = app.help();  // later it would be the help of the subcommand
  }

  /// Fills in the options from a command line that has been parsed. Throws CLI::ParseError.
  void finish() {
    leave_out_run();
    for (const auto& [subcommand, task] : tasks_)
      if (subcommand->parsed()) options_.task = task;
    if (options_.task == Options::Task::man) options_.usage = usage_;
    if (options_.task == Options::Task::completion) list_completions();
    if (options_.task == Options::Task::run && options_.decks.empty())
      throw CLI::RequiredError("a deck to solve, or one of check, help, template, manual, schema,");
    for (const std::string& word : words_) options_.card += (options_.card.empty() ? "" : " ") + word;
    for (const std::string& text : definitions_) add_definition(options_, text);
    if (options_.task == Options::Task::run) check_prefixes(options_);
  }

  CLI::App app{
      "engrane: flexible multibody mechanisms with gears, from a SAMCEF/MECANO-like deck\n\n"
      "  engrane deck.dat              solve; writes deck.h5, deck.xdmf and deck.lst here\n"
      "  engrane a.dat b.dat           solve one after the other; a summary ends it\n"
      "  engrane deck.dat -D A=0.3     the same with another text for the deck's abbreviation /A\n"
      "  engrane deck.dat --card \".SUB TF 1 H 1E-4\"    with another .SUB than the deck's\n"
      "  engrane check deck.dat        read and verify only, and say what would be built\n"
      "  engrane help GEAR             what a card takes; without a word, all cards\n"
      "  engrane help friction         which cards have to do with it\n"
      "  engrane template GEAR         a card to fill in\n"};

 private:
  void add_overrides(CLI::App& to) {
    to.add_option("-D,--define", definitions_, "text that stands for the abbreviation /NAME of the deck, whatever its ABRE says")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    to.add_option("--card", options_.wishes.overrides.cards,
                  "this card in the place of the deck's, for .SAM, .SUB and others that a deck has once: \".SUB TF 1 H 1E-3\"")
        ->type_name("CARD")
        ->allow_extra_args(false);
  }

  void add_run() {
    app.add_option("-o,--output", options_.prefix, "where the results go: prefix of .h5, .xdmf and .lst, or a folder/");
    app.add_flag("-q,--quiet", options_.quiet, "no progress, no advice, no summary of several decks");
    app.add_flag("--json", options_.json, "print status, effort, checks, energies and files as JSON, and nothing else");
    add_overrides(app);
    app.add_option("--result", options_.wishes.results, "print this number: \"ELEMENT 3 NORMAL_FORCE MAX\", as in .CHK")
        ->type_name("QUANTITY")
        ->allow_extra_args(false);
    app.add_flag("--condition", options_.condition,
                 "the listing also gives the condition of the last linear system, and a bound on the error of its solution");
    app.add_option("--until", options_.until,
                   "stop at the end of the first step that reaches this time; --restart continues from there")
        ->type_name("TIME")
        ->check(finite);
    auto* restart =
        app.add_option("--restart", options_.restart, "continue these results, as .SAM RESTART does")->type_name("PREFIX");
    app.add_option("--restart-at", options_.restart_time, "continue from the last restart point up to this time")
        ->type_name("TIME")
        ->check(finite)
        ->needs(restart);
    app.add_option("deck", options_.decks, "the decks to solve");
  }

  CLI::App* add_task(Options::Task task, const char* name, const char* help) {
    CLI::App* const subcommand = app.add_subcommand(name, help);
    tasks_.emplace_back(subcommand, task);
    return subcommand;
  }

  void add_tasks() {
    using Task = Options::Task;
    CLI::App* const check = add_task(Task::check, "check", "read and verify a deck, and say what would be built");
    check->add_option("deck", options_.decks, "the decks")->required();
    add_overrides(*check);
    check->add_flag(
        "--allow-user", options_.allow_user,
        "load user libraries that lie elsewhere than beside the deck or in ENGRANE_USER_PATH; this runs what is in them");
    add_task(Task::help, "help", "explain a card, or list all cards")
        ->add_option("card", words_, "GEAR, HINGE, .SAM, .CLM FIX ..., or words to look for: friction, gravity");
    add_task(Task::make_template, "template", "print a card to fill in")
        ->add_option("card", options_.card, "GEAR, HINGE, .SAM ...")
        ->required();
    add_task(Task::manual, "manual", "print the reference manual (Markdown)");
    add_task(Task::schema, "schema", "print all cards as a JSON schema");
    add_task(Task::completion, "completion", "print completions for bash: source <(engrane completion)");
    add_task(Task::man, "man", "print the manual page: engrane man > engrane.1");
  }

  /// `engrane run deck.dat`, as other programs have it, is `engrane deck.dat`, unless `run` is a deck.
  void leave_out_run() {
    std::vector<std::string>& decks = options_.decks;
    std::error_code error;
    if (options_.task == Options::Task::run && decks.size() > 1 && decks.front() == "run" &&
        !std::filesystem::exists("run", error))
      decks.erase(decks.begin());
  }

  void list_completions() {
    for (const CLI::App* task : app.get_subcommands({})) options_.tasks.push_back(task->get_name());
    // tasks of the launcher script
    for (const char* task : {"plot", "spectrum", "orders", "picture", "animate", "export", "import", "sweep", "study", "inertia",
                             "figures", "gallery", "demo", "test"})
      options_.tasks.emplace_back(task);
    for (const CLI::Option* option : app.get_options())
      if (!option->get_lnames().empty()) options_.words.push_back("--" + option->get_lnames().front());
  }

  Options& options_;
  std::vector<std::pair<CLI::App*, Options::Task>> tasks_;
  std::vector<std::string> definitions_, words_;  ///< `-D` and the words of `help`, as given
  std::string usage_;
};

}  // namespace

std::string results_prefix(const Options& options, const std::string& deck) {
  namespace fs = std::filesystem;
  const std::string name = fs::path(deck).stem().string();
  if (options.prefix.empty()) return name;
  const fs::path prefix = options.prefix, last = prefix.filename();
  std::error_code error;
  const bool folder =
      last.empty() || last == "." || last == ".." || (options.decks.size() > 1 && fs::is_directory(prefix, error));
  return folder ? (prefix / name).string() : options.prefix;
}

std::optional<Options> parse_command_line(int argc, char** argv, bool talk, int& status) {
  Options options;
  Grammar grammar(options);
  try {
    grammar.app.parse(own_words(argc, argv));
    grammar.finish();
    return options;
  } catch (const CLI::ParseError& e) {
    std::ostream silent(nullptr);
    const int code = talk ? grammar.app.exit(e, std::cout, std::cerr) : grammar.app.exit(e, silent, silent);
    status = code == 0 ? exit_status::fine : exit_status::wrong_deck;
    return std::nullopt;
  }
}

}  // namespace engrane::app
