"""Families: tops side by side, and maps of many."""
