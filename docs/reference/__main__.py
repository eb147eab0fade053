"""``python -m docs.reference``: write what is generated and kept with the documents anew."""

from docs.reference.kept import stale

for file, content in stale():
    file.parent.mkdir(exist_ok=True)
    file.write_text(content, encoding="utf-8")
    print(f"wrote {file}")
