"""What the formats of a state graph share: its words, its findings, its picture."""
