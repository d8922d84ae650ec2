"""What is asked: the families of problems, one small file each, and what they are made of.

Modules of this folder are what problems are made of; its subfolders are the topics, and every
file in a topic is one family. Nothing here ever sees an answer.
"""
