//! Commands in texts for people, and their words.

/// The lines that begin with `sweetspot `, or with the beginning of a `cargo run`, after an indent of that many spaces;
/// a line that ends in a backslash continues in the next.
pub fn commands(text: &str, indent: usize) -> Vec<String> {
    let joined = text.replace("\\\n", " ");
    let mut commands = Vec::new();
    for line in joined.lines() {
        let content = line.trim_start();
        if line.len() - content.len() != indent {
            continue;
        }
        let command = content.strip_prefix("cargo run --release -- ");
        let command = command.or_else(|| content.strip_prefix("sweetspot "));
        commands.extend(command.map(|command| command.trim_end().to_owned()));
    }
    commands
}

/// The words of a command line, as a shell takes them apart: quotes hold spaces, and `>` sends the
/// output elsewhere.
pub fn words(command: &str) -> Vec<String> {
    let mut words = Vec::new();
    let (mut word, mut quoted, mut begun) = (String::new(), false, false);
    for c in command.split(" > ").next().unwrap_or_default().chars() {
        match c {
            '"' => (quoted, begun) = (!quoted, true),
            c if c.is_whitespace() && !quoted => {
                if std::mem::take(&mut begun) {
                    words.push(std::mem::take(&mut word));
                }
            }
            c => {
                word.push(c);
                begun = true;
            }
        }
    }
    if begun {
        words.push(word);
    }
    words
}

/// The lines with more than that many columns.
pub fn wider(text: &str, columns: usize) -> Vec<String> {
    let wide = text.lines().filter(|line| line.chars().count() > columns);
    wide.map(str::to_owned).collect()
}
