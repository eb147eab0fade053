"""Tests of the exports, and small readers of what they write."""
