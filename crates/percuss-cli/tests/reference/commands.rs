//! The commands as the program explains them.

use std::fmt::Write;

use clap::Command;

/// The page of all commands.
pub(crate) fn page() -> String {
    let mut program = percuss_cli::command().term_width(80);
    program.build();
    let mut page = String::from(
        "# Commands\n\nWhat `percuss COMMAND --help` prints. This page is written by the program.\n",
    );
    add(&mut page, &program);
    page
}

fn add(page: &mut String, command: &Command) {
    let name = command.get_bin_name().unwrap_or_else(|| command.get_name());
    let help = command.clone().render_long_help().to_string();
    let lines: Vec<&str> = help.lines().map(str::trim_end).collect();
    let _ = write!(
        page,
        "\n## `{name}`\n\n```text\n{}\n```\n",
        lines.join("\n").trim_end()
    );
    for inner in command
        .get_subcommands()
        .filter(|inner| !inner.is_hide_set())
    {
        add(page, inner);
    }
}
