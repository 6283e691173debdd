"""What timed.py has recorded, and how a time is told."""


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.1f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def took(path):
    """CPU seconds of one record."""
    return float(path.read_text().split()[1])
