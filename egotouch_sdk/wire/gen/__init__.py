"""Classes that proto/generate.py makes from the schema; never edited by hand."""
