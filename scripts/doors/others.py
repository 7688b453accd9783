"""Of the staged sources those with changes beyond includes, one a line."""
import re, subprocess, sys
diff = subprocess.run(["git", "diff", "--cached", "-M", "-U0", "HEAD", "--", "*.cpp", "*.hpp"], capture_output=True, text=True, check=True).stdout
name, found = None, set()
for line in diff.splitlines():
    if line.startswith("+++ "):
        name = line[6:] if line.startswith("+++ b/") else None
    elif name and re.match(r"[-+](?!\+\+|--)", line) and not re.match(r"[-+]\s*#\s*include\b|[-+]$", line):
        found.add(name)
print("\n".join(sorted(n for n in found if "third_party" not in n)))
